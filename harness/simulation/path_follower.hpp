// Pure pursuit along a polyline (Coulter, CMU-RI-TR-92-01, 1992).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/types.hpp"
#include "sim/simulator.hpp"

namespace harness {

struct FollowerLimits {
  double speed = 0.6;         // [m/s] cruising speed
  double lookahead = 0.6;     // [m]
  double turn_rate = 1.0;     // [rad/s] highest turn rate
  double deceleration = 0.5;  // [m/s^2] before the end of the path
};

/// Follows a polyline once, or repeatedly if it is closed. Progress never goes back, so a path may cross
/// itself and a pose estimate may jump. The work of a step does not grow with the path.
class PathFollower {
 public:
  explicit PathFollower(const FollowerLimits& limits) : limits_(limits) {}

  /// Starts a new path. A closed path is entered at the point nearest to `start`, an open one at its
  /// beginning.
  void follow(std::span<const Eigen::Vector2d> points, bool closed, const Eigen::Vector2d& start);

  /// The command at this pose. It is to stand still at the end of an open path and without a path.
  sim::Command command(const seif::Pose2& T_world_robot);

  bool is_finished() const { return is_finished_; }

  /// The last point of an open path. [m]
  const Eigen::Vector2d& end() const { return points_.back(); }

 private:
  /// A place on the path, on the segment that begins at points_[segment].
  struct Place {
    std::size_t segment = 0;
    double along = 0.0;  // [m] from the beginning of the segment
  };

  double length(std::size_t segment) const;
  Eigen::Vector2d at(const Place& place) const;
  bool go_to_next_segment(Place& place) const;
  bool turns_back_after(std::size_t segment) const;
  Place nearest_in_all(const Eigen::Vector2d& p_world) const;
  void advance(const Eigen::Vector2d& p_world);
  Eigen::Vector2d target(const Eigen::Vector2d& p_world);
  sim::Command steer_to(const Eigen::Vector2d& p_robot_target, double to_stop);

  FollowerLimits limits_;
  std::vector<Eigen::Vector2d> points_;  // [m] a closed path repeats its first point at the end
  bool closed_ = false;
  bool is_finished_ = true;
  bool is_turning_ = false;  // turning on the spot until the target is ahead
  double to_stop_ = 0.0;     // [m] to the place where the robot must stop, if that is within the lookahead
  Place place_;              // progress of the robot
};

}  // namespace harness
