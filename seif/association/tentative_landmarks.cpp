#include "seif/association/tentative_landmarks.hpp"

#include <algorithm>

namespace seif {

void TentativeLandmarks::begin_scan(double wander) {
  ++scan_;
  std::erase_if(places_, [&](const Place& place) { return scan_ - place.last_scan > forget_after_; });
  for (Place& place : places_) place.variance += wander;
}

TentativeLandmarks::Sighting TentativeLandmarks::see(const Eigen::Vector2d& p_world, double variance,
                                                     double gate) {
  std::size_t nearest = places_.size();
  double least = gate;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const double distance = (place.p_world - p_world).squaredNorm() / (place.variance + variance);
    if (place.last_scan == scan_ || distance > least) continue;
    least = distance;
    nearest = i;
  }
  if (nearest == places_.size()) {
    nearest = room();
    places_[nearest] = {
        .p_world = p_world, .variance = variance, .times = 0, .first_scan = scan_, .last_scan = scan_};
  }
  Place& place = places_[nearest];
  place.p_world = p_world;
  place.variance = variance;
  place.last_scan = scan_;
  last_ = nearest;
  return {++place.times, scan_ - place.first_scan};
}

/// For one more: behind the others, or in the place of the one longest not seen.
std::size_t TentativeLandmarks::room() {
  if (places_.size() < most) {
    places_.emplace_back();
    return places_.size() - 1;
  }
  return static_cast<std::size_t>(std::ranges::min_element(places_, {}, &Place::last_scan) - places_.begin());
}

}  // namespace seif
