// Draws the ground with its grid in one view.
#pragma once

#include <vector>

#include "sim/render/frame.hpp"
#include "sim/render/sunlight.hpp"
#include "sim/render/vertex_array.hpp"

namespace render {

class GroundPass {
 public:
  explicit GroundPass(const Gl& gl);
  /// Draws into the plain image, before the things that stand on the ground. Only the areas in `shades` are
  /// tested for shadows, since the test is expensive.
  void draw(const Ground& ground, const Projection& projection, const Frame& frame, const Sunlight& sunlight,
            const std::vector<Shade>& shades);

 private:
  void set(const Program& program, const Ground& ground, const Projection& projection,
           const Frame& frame) const;

  const Gl& gl_;
  Program open_;
  Program shaded_;
  VertexArray parts_;
  std::vector<Shade> whole_;  // one entry: the whole ground
};

}  // namespace render
