// Vertex data: vertices that are the same in every frame, and instances that are new in each.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "sim/render/gl.hpp"
#include "sim/render/meshes.hpp"
#include "sim/render/scene.hpp"

namespace render {

/// A colour as the shaders take it: the bytes of an instance, alpha not premultiplied.
struct Rgba {
  Rgba() = default;
  explicit Rgba(const Colour& colour);
  std::uint8_t r = 0, g = 0, b = 0, a = 0;
};

/// A member of an instance: `components` floats, or the four bytes of an Rgba.
struct Attribute {
  static constexpr int colour = 0;
  int components;
};

class VertexArray {
 public:
  /// Instances are quads: the shader gets the four corners from gl_VertexID. Attributes are numbered from 0.
  VertexArray(const Gl& gl, std::initializer_list<Attribute> instance);
  /// Instances of a mesh. Attributes 0 and 1 are the mesh's positions and normals; those of the instance
  /// follow.
  VertexArray(const Gl& gl, const Mesh& mesh, std::initializer_list<Attribute> instance);

  template <typename Instance>
  void draw(const std::vector<Instance>& instances) {
    if (instances.empty()) return;
    upload(instances.data(), instances.size(), sizeof(Instance));
    draw_uploaded(static_cast<GLsizei>(instances.size()));
  }

  /// Draws one point for each instance, without corners.
  template <typename Instance>
  void draw_points(const std::vector<Instance>& instances) {
    if (instances.empty()) return;
    upload(instances.data(), instances.size(), sizeof(Instance));
    gl_.DrawArraysInstanced(GL_POINTS, 0, 1, static_cast<GLsizei>(instances.size()));
  }

 private:
  void describe(std::initializer_list<Attribute> instance, GLuint first);
  void upload(const void* data, std::size_t count, std::size_t size);
  void draw_uploaded(GLsizei count);

  const Gl& gl_;
  GLuint array_ = 0;
  GLuint instances_ = 0;
  GLsizei indices_ = 0;  // 0: quads
  std::size_t stride_ = 0;
};

}  // namespace render
