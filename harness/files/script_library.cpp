#include "harness/files/script_library.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "harness/files/output_file.hpp"

namespace harness {

const ScriptLibrary& chart_js() {
  static const ScriptLibrary library{
      "the plotting library Chart.js",
      "libjs-chart.js",
      {"/usr/share/javascript/chart.js/chart.min.js", "/usr/share/nodejs/chart.js/dist/chart.min.js",
       "/usr/local/share/javascript/chart.js/chart.min.js"}};
  return library;
}

const ScriptLibrary& three_js() {
  static const ScriptLibrary library{
      "the 3D library three.js",
      "libjs-three",
      {"/usr/share/javascript/three/three.min.js", "/usr/share/javascript/three/build/three.min.js",
       "/usr/share/nodejs/three/build/three.min.js", "/usr/local/share/javascript/three/three.min.js"}};
  return library;
}

const ScriptLibrary& orbit_controls() {
  static const ScriptLibrary library{
      "OrbitControls of the 3D library three.js",
      "libjs-three",
      {"/usr/share/javascript/three/examples/js/controls/OrbitControls.js",
       "/usr/share/nodejs/three/examples/js/controls/OrbitControls.js",
       "/usr/local/share/javascript/three/examples/js/controls/OrbitControls.js"}};
  return library;
}

std::string read_script(const ScriptLibrary& library) {
  for (const std::string_view file : library.files) {
    if (std::filesystem::exists(file)) return read_whole_file(file);
  }
  throw std::runtime_error(fmt::format("{} is missing (Debian's package {})", library.name, library.package));
}

}  // namespace harness
