// What is drawn into.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/render/frame.hpp"
#include "sim/render/image.hpp"
#include "sim/render/program.hpp"

namespace render {

/// Things are drawn into a multisampled layer with depth, which is then laid over the plain image:
/// multisampling is dear without a graphics card, and ground, marks and overlay are smooth by themselves.
class Targets {
 public:
  /// Throws std::invalid_argument for a size that is not positive or too large.
  Targets(const Gl& gl, int width, int height);

  // What is drawn after these goes into...
  void use_plain() const { gl_.BindFramebuffer(GL_FRAMEBUFFER, plain_); }
  void use_layer() const { gl_.BindFramebuffer(GL_FRAMEBUFFER, layer_); }

  /// Fills the plain image, and empties the layer.
  void clear(const Colour& background) const;
  /// Lays this part of the layer over the plain image, which is used from then on.
  void compose(const Frame& frame) const;
  /// Repeats a part of the plain image, which is used from then on; the parts are of one size and apart.
  void repeat(const Frame& from, const Frame& to) const;
  /// For shaders that call visible() of layer_glsl. The layer may not be drawn into meanwhile.
  void set_layer(const Program& program) const;

  void read(Image& image);

 private:
  GLuint attach_layer(GLenum attachment, GLenum format);

  const Gl& gl_;
  int width_;
  int height_;
  GLuint plain_ = 0;
  GLuint layer_ = 0;
  GLuint layer_colour_ = 0;
  GLuint layer_depth_ = 0;
  Program compose_;
  GLuint compose_array_ = 0;
  std::vector<std::uint8_t> rgba_;  // from the bottom
};

/// GLSL: `visible()` is how much of a fragment's pixel shows it before or between the things of the layer.
extern const char* const layer_glsl;
/// The same for what is seen through everything.
extern const char* const everywhere_glsl;

}  // namespace render
