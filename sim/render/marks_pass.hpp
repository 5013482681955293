// Draws flat marks in one view.
#pragma once

#include <vector>

#include "sim/render/capsules.hpp"
#include "sim/render/ellipses.hpp"

namespace render {

class MarksPass {
 public:
  explicit MarksPass(const Gl& gl);
  /// Draws over everything.
  void draw(const Marks& marks, const Projection& projection, const Frame& frame);
  /// Draws behind things of the layer that are nearer to the camera.
  void draw_behind(const Targets& layer, const Marks& marks, const Projection& projection,
                   const Frame& frame);

 private:
  void collect(const Marks& marks, const Projection& projection, const Frame& frame);

  EllipsePainter ellipse_painter_;
  CapsulePainter capsule_painter_;
  std::vector<ScreenEllipse> ellipses_;
  std::vector<Capsule> capsules_;
};

}  // namespace render
