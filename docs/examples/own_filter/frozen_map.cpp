// A first filter: dead reckoning, and a map in which each landmark is the mean of its first sightings.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seif/models.hpp"
#include "seif/option_table.hpp"
#include "seif/plugin.hpp"

namespace {

struct FrozenMapOptions {
  int sightings = 1;  // [-]
};

class FrozenMap final : public seif::Estimator {
 public:
  FrozenMap(const seif::EstimatorSetup& setup, const FrozenMapOptions& options)
      : pose_(setup.start.mean), T_robot_sensor_(setup.T_robot_sensor), options_(options) {}

  void motion_update(const seif::Odometry& odometry) override {
    pose_ = seif::predict_pose(pose_, odometry).pose;
  }

  /// Moves a landmark to the mean of where it was seen, until it has been seen often enough.
  void measurement_update(const seif::Scan& scan, const seif::StageDone& done) override {
    for (const seif::Observation& observation : scan.observations) {
      const auto seen = seif::invert_observation(pose_, T_robot_sensor_, observation);
      auto landmark = std::ranges::find(map_, observation.landmark, &seif::LandmarkEstimate::landmark);
      if (landmark == map_.end()) {
        map_.push_back({observation.landmark, seen.p_world_landmark});
        sightings_.push_back(1);
        continue;
      }
      int& sightings = sightings_[static_cast<std::size_t>(landmark - map_.begin())];
      if (sightings == options_.sightings) continue;
      ++sightings;
      landmark->mean += (seen.p_world_landmark - landmark->mean) / sightings;
    }
    done(seif::Stage::measurement);
  }

  seif::Pose2 pose() const override { return pose_; }
  std::vector<seif::LandmarkEstimate> map() const override { return map_; }
  seif::Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return map_.capacity() * sizeof map_[0]; }

  /// This filter does not know how wrong it is.
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId>) const override {
    return std::nullopt;
  }

 private:
  seif::Pose2 pose_;           // T_world_robot
  seif::Pose2 T_robot_sensor_;
  FrozenMapOptions options_;
  std::vector<seif::LandmarkEstimate> map_;
  std::vector<int> sightings_;  // [-] of each landmark of the map
};

/// What a world file, `seifbed estimators` and `seifbed schema` know of the filter.
void add_frozen_map(seif::Registry& registry) {
  seif::OptionTable<FrozenMapOptions> table;
  table.number(
      "sightings", [](FrozenMapOptions& o) -> int& { return o.sightings; }, {.min = 1, .max = 1000},
      "Sightings of a landmark after which it does not move any more [-].");
  registry.add({.name = "frozen_map",
                .help = "Dead reckoning, and a map of mean sightings.",
                .options = table.specs(),
                .make = [table](const seif::EstimatorSetup& setup, const seif::Options& options) {
                  return std::make_unique<FrozenMap>(setup, table.read(options));
                }});
}

}  // namespace

SEIF_PLUGIN(add_frozen_map)
