// The version of the libraries and of the program.
#pragma once

namespace seif {

// CMakeLists.txt reads these three lines.
inline constexpr int version_major = 0;
inline constexpr int version_minor = 1;
inline constexpr int version_patch = 0;

}  // namespace seif
