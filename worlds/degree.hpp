// Only world files use degrees; everything else is in radians.
#pragma once

#include <numbers>

namespace worlds {

inline constexpr double degree = std::numbers::pi / 180;  // [rad]

}  // namespace worlds
