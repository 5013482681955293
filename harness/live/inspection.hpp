// What an estimator believes about one landmark, for whoever clicks on it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "harness/run/live_estimator.hpp"
#include "harness/stream/stream.hpp"
#include "harness/web/page_server.hpp"

namespace harness {

/// The latest observations of each landmark, by the id that they bear, in bounded memory for each.
class SightingLog {
 public:
  struct Sighting {
    float t = 0.0F;                          // [s]
    float range = 0.0F;                      // [m]
    float bearing = 0.0F;                    // [rad]
    float x = 0.0F, y = 0.0F, theta = 0.0F;  // where the robot was [m, m, rad]; not a number if not known
  };

  void add(const ScanEvent& event);

  /// The latest ones, the oldest first.
  std::vector<Sighting> of(seif::LandmarkId landmark) const;
  std::int64_t count(seif::LandmarkId landmark) const;

 private:
  static constexpr std::size_t kept = 8;  // [-] for each landmark

  struct Ring {
    std::int64_t count = 0;  // [-] so far
    std::array<Sighting, kept> sightings;
  };

  std::unordered_map<seif::LandmarkId, Ring> rings_;
};

/// `{"kind":"landmark",..}`. `truth` is the true position, if it is known [m]. Throws BadInput if the landmark is not in
/// the estimator's map. Factorises the estimator's whole matrix, unless it has covariances at hand.
PageMessage landmark_message(const LiveEstimator& estimator, seif::LandmarkId landmark,
                             const std::optional<Eigen::Vector2d>& truth, const SightingLog& sightings);

}  // namespace harness
