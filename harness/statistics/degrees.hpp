// Degrees, for output only. Everything else is in radians.
#pragma once

#include <numbers>

namespace harness {

inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi;  // [deg/rad]

}  // namespace harness
