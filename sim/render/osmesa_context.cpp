#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/render/context.hpp"

namespace render {

namespace {

/// Loads the library, for good: Mesa keeps its own threads and handlers until the program ends.
void* loaded(const std::vector<std::string>& libraries) {
  for (const std::string& name : libraries) {
    if (void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
  }
  throw std::runtime_error("OSMesa, which draws without a display, is missing: install libosmesa6 (Debian)");
}

template <typename Signature>
Signature* symbol(void* handle, const char* name) {
  void* address = dlsym(handle, name);
  if (address == nullptr) throw std::runtime_error(std::string("OSMesa has no ") + name);
  return reinterpret_cast<Signature*>(address);
}

}  // namespace

struct Context::Library {
  explicit Library(void* handle)
      : create(symbol<decltype(OSMesaCreateContextAttribs)>(handle, "OSMesaCreateContextAttribs")),
        destroy(symbol<decltype(OSMesaDestroyContext)>(handle, "OSMesaDestroyContext")),
        make_current(symbol<decltype(OSMesaMakeCurrent)>(handle, "OSMesaMakeCurrent")),
        proc_address(symbol<decltype(OSMesaGetProcAddress)>(handle, "OSMesaGetProcAddress")) {}
  ~Library() {
    if (context != nullptr) destroy(context);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  decltype(OSMesaCreateContextAttribs)* create;
  decltype(OSMesaDestroyContext)* destroy;
  decltype(OSMesaMakeCurrent)* make_current;
  decltype(OSMesaGetProcAddress)* proc_address;
  OSMesaContext context = nullptr;
  // OSMesa requires an image of its own, but drawing goes into framebuffer objects.
  std::array<std::uint8_t, 4 * 16 * 16> unused = {};
};

std::vector<std::string> Context::libraries() { return {"libOSMesa.so.8", "libOSMesa.so"}; }

Context::Context(const std::vector<std::string>& libraries)
    : library_(std::make_unique<Library>(loaded(libraries))) {
  static constexpr std::array<int, 11> attributes = {OSMESA_FORMAT,
                                                     OSMESA_RGBA,
                                                     OSMESA_PROFILE,
                                                     OSMESA_CORE_PROFILE,
                                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                                     3,
                                                     OSMESA_CONTEXT_MINOR_VERSION,
                                                     3,
                                                     OSMESA_DEPTH_BITS,
                                                     0,
                                                     0};
  library_->context = library_->create(attributes.data(), nullptr);
  if (library_->context == nullptr) throw std::runtime_error("OSMesa cannot make an OpenGL 3.3 core context");
  make_current();
}

Context::~Context() = default;

void Context::make_current() {
  if (library_->make_current(library_->context, library_->unused.data(), GL_UNSIGNED_BYTE, 16, 16) != GL_TRUE)
    throw std::runtime_error("OSMesa cannot make its context current");
}

Context::Function Context::proc(const char* name) const { return library_->proc_address(name); }

}  // namespace render

#ifdef __SANITIZE_ADDRESS__
/// The leak sanitizer sometimes crashes on the thread-local memory of Mesa's threads, which outlive main().
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "use_tls=0"; }

/// Mesa never frees a record of 160 bytes that it makes for each context.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so"; }
#endif
