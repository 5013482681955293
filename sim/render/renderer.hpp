// Turns a Scene into pixels, without a display.
#pragma once

#include <memory>
#include <string>

#include "sim/render/image.hpp"
#include "sim/render/scene.hpp"

namespace render {

class Renderer {
 public:
  /// Throws std::runtime_error with the name of what to install if the graphics library or a font is missing,
  /// and std::invalid_argument for a size that is not positive or too large.
  Renderer(int width, int height);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws the scene over the whole image. The work grows with the content of the scene. The same scene gives
  /// the same pixels. Throws std::runtime_error if the graphics library fails.
  void draw(const Scene& scene, Image& image);

  /// The graphics library and its version, for instance "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6".
  const std::string& description() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The width of a line of text. [px]
float text_width(const std::string& text, float size, Weight weight);

}  // namespace render
