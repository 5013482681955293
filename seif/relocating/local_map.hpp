// The map of a robot that has lost its place: a filter of its own, which starts where the robot was then.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "seif/estimator.hpp"
#include "seif/relocating/surroundings.hpp"

namespace seif {

class LocalMap {
 public:
  /// Makes a filter that has a local belief.
  using MakeFilter = std::function<std::unique_ptr<Estimator>(const EstimatorSetup&)>;

  static constexpr std::size_t most_carried = 64;  // [-] landmarks that a relocation brings into the map

  LocalMap(MakeFilter make_filter, const Pose2& T_robot_sensor)
      : make_filter_(std::move(make_filter)), T_robot_sensor_(T_robot_sensor) {}

  /// An empty map, around the robot.
  void begin();
  bool is_begun() const { return filter_ != nullptr; }
  void end() { filter_.reset(); }

  void motion_update(const Odometry& odometry) { filter_->motion_update(odometry); }
  void measurement_update(const Scan& scan);

  /// The nearest landmarks around the robot, at most `most`, by this map's names. Bounded work. Right after
  /// measurement_update().
  Surroundings read(double t, std::size_t most);

  /// [-] Scans that saw something.
  int scans() const { return scans_; }
  const Estimator& filter() const { return *filter_; }

 private:
  MakeFilter make_filter_;
  Pose2 T_robot_sensor_;
  std::unique_ptr<Estimator> filter_;
  int scans_ = 0;
};

}  // namespace seif
