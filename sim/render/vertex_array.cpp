#include "sim/render/vertex_array.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace render {

namespace {

std::uint8_t byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

/// OpenGL takes an offset in a parameter that was once a pointer.
const void* offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr): never a place in memory
}

GLuint new_buffer(const Gl& gl, GLenum target, const void* data, std::size_t bytes) {
  GLuint buffer = 0;
  gl.GenBuffers(1, &buffer);
  gl.BindBuffer(target, buffer);
  gl.BufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  return buffer;
}

}  // namespace

Rgba::Rgba(const Colour& colour)
    : r(byte(colour.r)), g(byte(colour.g)), b(byte(colour.b)), a(byte(colour.a)) {}

VertexArray::VertexArray(const Gl& gl, std::initializer_list<Attribute> instance) : gl_(gl) {
  gl_.GenVertexArrays(1, &array_);
  gl_.BindVertexArray(array_);
  describe(instance, 0);
}

VertexArray::VertexArray(const Gl& gl, const Mesh& mesh, std::initializer_list<Attribute> instance)
    : gl_(gl), indices_(static_cast<GLsizei>(mesh.indices.size())) {
  gl_.GenVertexArrays(1, &array_);
  gl_.BindVertexArray(array_);
  new_buffer(gl, GL_ARRAY_BUFFER, mesh.vertices.data(), mesh.vertices.size() * sizeof(Vertex));
  for (const GLuint attribute : {0U, 1U}) {
    gl_.EnableVertexAttribArray(attribute);
    gl_.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                            offset(attribute * 3 * sizeof(float)));
  }
  new_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, mesh.indices.data(), mesh.indices.size() * sizeof(std::uint16_t));
  describe(instance, 2);
}

void VertexArray::describe(std::initializer_list<Attribute> instance, GLuint first) {
  const auto size = [](const Attribute& attribute) {
    return attribute.components == Attribute::colour
               ? 4U
               : sizeof(float) * static_cast<std::size_t>(attribute.components);
  };
  for (const Attribute& attribute : instance) stride_ += size(attribute);
  gl_.GenBuffers(1, &instances_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, instances_);
  std::size_t at = 0;
  for (const Attribute& attribute : instance) {
    const bool colour = attribute.components == Attribute::colour;
    gl_.EnableVertexAttribArray(first);
    gl_.VertexAttribPointer(first, colour ? 4 : attribute.components, colour ? GL_UNSIGNED_BYTE : GL_FLOAT,
                            colour ? GL_TRUE : GL_FALSE, static_cast<GLsizei>(stride_), offset(at));
    gl_.VertexAttribDivisor(first++, 1);
    at += size(attribute);
  }
}

void VertexArray::upload(const void* data, std::size_t count, std::size_t size) {
  if (size != stride_) throw std::logic_error("an instance is not what was described");
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, instances_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * size), data, GL_STREAM_DRAW);
}

void VertexArray::draw_uploaded(GLsizei count) {
  if (indices_ == 0) {
    gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
  } else {
    gl_.DrawElementsInstanced(GL_TRIANGLES, indices_, GL_UNSIGNED_SHORT, nullptr, count);
  }
}

}  // namespace render
