#include "sim/render/program.hpp"

#include <array>
#include <stdexcept>

namespace render {

namespace {

GLuint compiled(const Gl& gl, GLenum kind, const std::string& name, const std::string& source) {
  const std::string text = "#version 330 core\n" + source;
  const char* data = text.c_str();
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &data, nullptr);
  gl.CompileShader(shader);
  GLint success = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &success);
  if (success == GL_TRUE) return shader;
  std::array<char, 2000> log = {};
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::runtime_error("the shader of the " + name + " does not compile: " + log.data());
}

}  // namespace

Program::Program(const Gl& gl, const std::string& name, const std::string& vertex,
                 const std::string& fragment)
    : gl_(gl), name_(name), program_(gl.CreateProgram()) {
  for (const GLuint shader :
       {compiled(gl, GL_VERTEX_SHADER, name, vertex), compiled(gl, GL_FRAGMENT_SHADER, name, fragment)}) {
    gl.AttachShader(program_, shader);
    gl.DeleteShader(shader);  // freed together with the program
  }
  gl.LinkProgram(program_);
  GLint success = 0;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &success);
  if (success == GL_TRUE) return;
  std::array<char, 2000> log = {};
  gl.GetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::runtime_error("the shaders of the " + name + " do not link: " + log.data());
}

GLint Program::location(const char* name) const {
  const GLint location = gl_.GetUniformLocation(program_, name);
  if (location < 0) throw std::logic_error("the shaders of the " + name_ + " have no " + name);
  return location;
}

void Program::set(const char* name, int value) const { gl_.Uniform1i(location(name), value); }

void Program::set(const char* name, float value) const { gl_.Uniform1f(location(name), value); }

void Program::set(const char* name, const Eigen::Vector2f& value) const {
  gl_.Uniform2f(location(name), value.x(), value.y());
}

void Program::set(const char* name, const Eigen::Vector3f& value) const {
  gl_.Uniform3f(location(name), value.x(), value.y(), value.z());
}

void Program::set(const char* name, const Eigen::Vector4f& value) const {
  gl_.Uniform4f(location(name), value.x(), value.y(), value.z(), value.w());
}

void Program::set(const char* name, const Eigen::Matrix3f& value) const {
  gl_.UniformMatrix3fv(location(name), 1, GL_FALSE, value.data());
}

void Program::set(const char* name, const Eigen::Matrix4f& value) const {
  gl_.UniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

void Program::set(const char* name, const Colour& value) const {
  set(name, Eigen::Vector4f(value.r, value.g, value.b, value.a));
}

}  // namespace render
