#include "harness/figures/palette.hpp"

#include <algorithm>
#include <array>

#include "harness/files/fnv1a.hpp"

namespace harness {

namespace {

struct Entry {
  std::string_view type;
  Rgb colour;
};

// Seven colours are not enough, so related filters share a colour, with a dark shade for one of them. Yellow
// is too pale for white paper.
constexpr Rgb dark_blue = 0x003F7F;
constexpr Rgb dark_green = 0x005F45;
constexpr Rgb light_green = 0x6FBF3A;
constexpr Rgb dark_vermilion = 0x7F3800;
constexpr Rgb dark_purple = 0x7B2D5B;
constexpr Rgb dark_yellow = 0x8A7F00;
constexpr Rgb brown = 0x8C5A2B;
constexpr Rgb dark_sky_blue = 0x2F6F95;

constexpr std::array<Entry, 11> own = {{
    {"ekf", palette::blue},
    {"mrpt_ekf", dark_blue},
    {"eif", palette::sky_blue},
    {"seif", palette::green},
    {"seif_gauge_free", dark_green},
    {"multi_seif", light_green},
    {"seif_report", palette::vermilion},
    {"seif_modified", dark_vermilion},
    {"seif_exact", palette::orange},
    {"eseif", palette::purple},
    {"batch", dark_purple},
}};

constexpr std::array<Rgb, 3> shared = {dark_yellow, dark_sky_blue, brown};

}  // namespace

Rgb colour_of_estimator(std::string_view type) {
  const auto found = std::ranges::find(own, type, &Entry::type);
  if (found != own.end()) return found->colour;
  Fnv1a hash;
  hash.add(type);
  return shared.at(hash.value() % shared.size());
}

}  // namespace harness
