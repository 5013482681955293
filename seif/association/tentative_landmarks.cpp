#include "seif/association/tentative_landmarks.hpp"

#include <algorithm>

namespace seif {

void TentativeLandmarks::begin_scan(double wander) {
  ++scan_;
  std::erase_if(tentative_,
                [&](const Tentative& landmark) { return scan_ - landmark.last_scan > forget_after_; });
  for (Tentative& landmark : tentative_) landmark.variance += wander;
}

TentativeLandmarks::Sighting TentativeLandmarks::see(const Eigen::Vector2d& p_world, double variance,
                                                     double gate) {
  std::size_t nearest = tentative_.size();
  double least = gate;
  for (std::size_t i = 0; i < tentative_.size(); ++i) {
    const Tentative& landmark = tentative_[i];
    const double distance = (landmark.p_world - p_world).squaredNorm() / (landmark.variance + variance);
    if (landmark.last_scan == scan_ || distance > least) continue;
    least = distance;
    nearest = i;
  }
  if (nearest == tentative_.size()) {
    nearest = room();
    tentative_[nearest] = {
        .p_world = p_world, .variance = variance, .times = 0, .first_scan = scan_, .last_scan = scan_};
  }
  Tentative& landmark = tentative_[nearest];
  landmark.p_world = p_world;
  landmark.variance = variance;
  landmark.last_scan = scan_;
  last_ = nearest;
  return {++landmark.times, scan_ - landmark.first_scan};
}

/// For one more: behind the others, or instead of the one longest not seen.
std::size_t TentativeLandmarks::room() {
  if (tentative_.size() < most_tentative) {
    tentative_.emplace_back();
    return tentative_.size() - 1;
  }
  return static_cast<std::size_t>(std::ranges::min_element(tentative_, {}, &Tentative::last_scan) -
                                  tentative_.begin());
}

}  // namespace seif
