// The palette of films, plots and reports: the colours of Okabe and Ito, which colour-blind people can tell
// apart. An estimator has the colour of its type everywhere.
#pragma once

#include <cstdint>
#include <string_view>

namespace harness {

/// 0xRRGGBB in sRGB.
using Rgb = std::uint32_t;

namespace palette {
inline constexpr Rgb truth = 0x000000;
inline constexpr Rgb odometry = 0x8C8C8C;
inline constexpr Rgb orange = 0xE69F00;
inline constexpr Rgb sky_blue = 0x56B4E9;
inline constexpr Rgb green = 0x009E73;
inline constexpr Rgb yellow = 0xF0E442;
inline constexpr Rgb blue = 0x0072B2;
inline constexpr Rgb vermilion = 0xD55E00;
inline constexpr Rgb purple = 0xCC79A7;
}  // namespace palette

/// The colour of estimators of this type. Types that are not ours share the remaining colours.
Rgb colour_of_estimator(std::string_view type);

}  // namespace harness
