// Libraries of JavaScript that packages install, and that pages carry in themselves.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace harness {

struct ScriptLibrary {
  std::string_view name;                // as people call it
  std::string_view package;             // of Debian
  std::vector<std::string_view> files;  // where it may be installed
};

/// Chart.js, for plots.
const ScriptLibrary& chart_js();
/// three.js, for scenes in 3D.
const ScriptLibrary& three_js();
/// The controls of three.js by which one turns and moves a scene.
const ScriptLibrary& orbit_controls();

/// The text of a library. Throws std::runtime_error that names the package if it is not installed.
std::string read_script(const ScriptLibrary& library);

}  // namespace harness
