#include "sim/render/targets.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace render {

namespace {

constexpr GLsizei samples = 4;

const char* const compose_vertex_shader = R"(
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0, 0.0, 1.0); }
)";

const char* const compose_fragment_shader = R"(
uniform sampler2DMS layer;
out vec4 painted;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  painted = 0.25 * (texelFetch(layer, at, 0) + texelFetch(layer, at, 1) + texelFetch(layer, at, 2) +
                    texelFetch(layer, at, 3));
}
)";

void check_size(const Gl& gl, int width, int height) {
  if (width <= 0 || height <= 0) throw std::invalid_argument("an image needs a positive size");
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width > largest || height > largest)
    throw std::invalid_argument("an image may not have more than " + std::to_string(largest) + " px a side");
}

void check_complete(const Gl& gl) {
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the graphics library has no multisampled framebuffers");
}

}  // namespace

const char* const layer_glsl = R"(
uniform sampler2DMS layer_depth;
float visible() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 depths = vec4(texelFetch(layer_depth, at, 0).r, texelFetch(layer_depth, at, 1).r,
                     texelFetch(layer_depth, at, 2).r, texelFetch(layer_depth, at, 3).r);
  return dot(vec4(greaterThanEqual(depths, vec4(gl_FragCoord.z))), vec4(0.25));
}
)";

const char* const everywhere_glsl = "float visible() { return 1.0; }\n";

Targets::Targets(const Gl& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      compose_(gl, "layer", compose_vertex_shader, compose_fragment_shader) {
  check_size(gl, width, height);
  GLuint colour = 0;
  gl_.GenRenderbuffers(1, &colour);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, colour);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  gl_.GenFramebuffers(1, &plain_);
  use_plain();
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
  check_complete(gl);
  gl_.GenFramebuffers(1, &layer_);
  use_layer();
  layer_colour_ = attach_layer(GL_COLOR_ATTACHMENT0, GL_RGBA8);
  layer_depth_ = attach_layer(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24);
  check_complete(gl);
  gl_.GenVertexArrays(1, &compose_array_);
  rgba_.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

GLuint Targets::attach_layer(GLenum attachment, GLenum format) {
  GLuint texture = 0;
  gl_.GenTextures(1, &texture);
  gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
  gl_.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, format, width_, height_, GL_TRUE);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D_MULTISAMPLE, texture, 0);
  return texture;
}

void Targets::clear(const Colour& background) const {
  gl_.Disable(GL_SCISSOR_TEST);
  use_layer();
  gl_.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  use_plain();
  gl_.ClearColor(background.r, background.g, background.b, 1.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
}

void Targets::compose(const Frame& frame) const {
  use_plain();
  enter(gl_, frame);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Enable(GL_BLEND);
  compose_.use();
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, layer_colour_);
  compose_.set("layer", 0);
  gl_.BindVertexArray(compose_array_);
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Targets::repeat(const Frame& from, const Frame& to) const {
  use_plain();  // for reading, too
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.BlitFramebuffer(from.x, from.y, from.x + from.width, from.y + from.height, to.x, to.y, to.x + to.width,
                      to.y + to.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Targets::set_layer(const Program& program) const {
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, layer_depth_);
  program.set("layer_depth", 0);
}

void Targets::read(Image& image) {
  use_plain();
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  image.width = width_;
  image.height = height_;
  const auto width = static_cast<std::size_t>(width_);
  const auto height = static_cast<std::size_t>(height_);
  image.rgb.resize(3 * width * height);
  std::uint8_t* to = image.rgb.data();
  for (std::size_t row = height; row-- > 0;) {
    const std::uint8_t* from = &rgba_[4 * width * row];
    for (std::size_t x = 0; x < width; ++x, from += 4, to += 3) {
      to[0] = from[0];
      to[1] = from[1];
      to[2] = from[2];
    }
  }
}

}  // namespace render
