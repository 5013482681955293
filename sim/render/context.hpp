// Where OpenGL comes from. The one place to change for another way to draw without a display.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace render {

/// An OpenGL 3.3 core context without a window. What is made in it lives as long as it does.
class Context {
 public:
  /// The names under which the library is looked for.
  static std::vector<std::string> libraries();

  /// Takes the first of these libraries that there is. Throws std::runtime_error that says what to install if
  /// there is none.
  explicit Context(const std::vector<std::string>& libraries);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Calls from this thread go to this context from now on. Throws std::runtime_error.
  void make_current();

  using Function = void (*)();
  /// The function of this name; null if there is none.
  Function proc(const char* name) const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace render
