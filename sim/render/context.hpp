// Provides OpenGL. This is the only place to change for another way to draw without a display.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace render {

/// An OpenGL 3.3 core context without a window. Objects that are made in it live as long as the context.
class Context {
 public:
  /// The file names that are tried for the library.
  static std::vector<std::string> libraries();

  /// Loads the first of these libraries that exists. If there is none, throws std::runtime_error with the name
  /// of what to install.
  explicit Context(const std::vector<std::string>& libraries);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// From now on, OpenGL calls from this thread go to this context. Throws std::runtime_error.
  void make_current();

  using Function = void (*)();
  /// The function with this name; null if it does not exist.
  Function proc(const char* name) const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace render
