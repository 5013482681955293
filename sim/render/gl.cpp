#include "sim/render/gl.hpp"

#include <stdexcept>
#include <string>

namespace render {

namespace {

template <typename Pointer>
Pointer load(const Context& context, const char* name) {
  const Context::Function function = context.proc(name);
  if (function == nullptr) throw std::runtime_error(std::string("the graphics library has no ") + name);
  return reinterpret_cast<Pointer>(function);
}

}  // namespace

#define RENDER_GL_LOAD(name, type) name = load<PFNGL##type##PROC>(context, "gl" #name);
Gl::Gl(const Context& context) { RENDER_GL_FUNCTIONS(RENDER_GL_LOAD) }
#undef RENDER_GL_LOAD

void Gl::check(const char* doing) const {
  const GLenum error = GetError();
  if (error == GL_NO_ERROR) return;
  throw std::runtime_error(std::string("the graphics library failed while ") + doing + ": error " +
                           std::to_string(error));
}

}  // namespace render
