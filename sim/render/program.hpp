// A program of a vertex shader and a fragment shader.
#pragma once

#include <Eigen/Core>
#include <string>

#include "sim/render/gl.hpp"
#include "sim/render/scene.hpp"

namespace render {

class Program {
 public:
  /// The sources follow the line with the version. Throws std::runtime_error with the compiler's message.
  Program(const Gl& gl, const std::string& name, const std::string& vertex, const std::string& fragment);

  void use() const { gl_.UseProgram(program_); }

  // Sets a variable of the program in use. A name that the shaders do not have is a programmer's error:
  // std::logic_error.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix3f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;
  void set(const char* name, const Colour& value) const;

 private:
  GLint location(const char* name) const;

  const Gl& gl_;
  std::string name_;
  GLuint program_;
};

}  // namespace render
