#include "seif/relocating/settled_constellations.hpp"

#include <algorithm>

namespace seif {
namespace {

constexpr int settled_after = 15;        // [-] scans until a landmark's place counts
constexpr std::size_t most_settled = 2;  // [-] landmarks that one scan adds
constexpr double widths = 4.0;           // [-] of the index, over the standard deviation of a sighting
constexpr double nears = 5.0;            // [-] the same, of near()

}  // namespace

void SettledConstellations::widen(double range, double sighting_sd) {
  reach_ = std::max(reach_, range);
  ++sightings_;
  sighting_sd_ += (sighting_sd - sighting_sd_) / static_cast<double>(sightings_);
}

void SettledConstellations::keep_up(int scan) {
  just_settled_.clear();
  while (just_settled_.size() < most_settled && next_young_ < young_.size() &&
         scan - young_[next_young_].joined >= settled_after)
    add_next();
  // Half of them at once: so the list stays short while the robot explores, and few move for each that goes.
  if (2 * next_young_ < young_.size()) return;
  young_.erase(young_.begin(), young_.begin() + static_cast<std::ptrdiff_t>(next_young_));
  next_young_ = 0;
}

void SettledConstellations::settle_all() {
  while (next_young_ < young_.size()) add_next();
}

void SettledConstellations::add_next() {
  if (!index_) {
    index_.emplace(widths * sighting_sd_);
    near_ = nears * sighting_sd_;
  }
  const LandmarkId landmark = young_[next_young_++].landmark;
  if (!grid_.has(landmark)) return;
  index_->add(grid_, landmark, reach_);
  just_settled_.push_back(landmark);
  work_ += ConstellationIndex::neighbours;
}

std::size_t SettledConstellations::memory_bytes() const {
  return (index_ ? index_->memory_bytes() : 0) + young_.capacity() * sizeof(Young);
}

}  // namespace seif
