// The images that are drawn into.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/render/frame.hpp"
#include "sim/render/image.hpp"
#include "sim/render/program.hpp"

namespace render {

/// Things are drawn into a multisampled layer with depth, which is then composed over the plain image.
/// Multisampling is slow without a graphics card, and ground, marks and overlay are smooth without it.
class Targets {
 public:
  /// Throws std::invalid_argument for a size that is not positive or too large.
  Targets(const Gl& gl, int width, int height);

  // After these calls, drawing goes into the plain image or the layer.
  void use_plain() const { gl_.BindFramebuffer(GL_FRAMEBUFFER, plain_); }
  void use_layer() const { gl_.BindFramebuffer(GL_FRAMEBUFFER, layer_); }

  /// Fills the plain image, and clears the layer.
  void clear(const Colour& background) const;
  /// Composes this part of the layer over the plain image. The plain image is in use afterwards.
  void compose(const Frame& frame) const;
  /// Copies a part of the plain image to another part; the two have the same size and do not overlap. The plain
  /// image is in use afterwards.
  void repeat(const Frame& from, const Frame& to) const;
  /// For shaders that call visible() of layer_glsl. Nothing may be drawn into the layer while they run.
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
  std::vector<std::uint8_t> rgba_;  // rows from the bottom
};

/// GLSL: `visible()` is the fraction of a fragment's pixel in which the fragment is not hidden by the things of
/// the layer.
extern const char* const layer_glsl;
/// The same for marks that are seen through everything.
extern const char* const everywhere_glsl;

}  // namespace render
