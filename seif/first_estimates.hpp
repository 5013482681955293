// Where each landmark was first believed to be. Jacobians are taken at these points as far as they concern
// motions that no observation can show.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/first_estimate_frame.hpp"
#include "seif/types.hpp"

namespace seif {

/// Moving and turning robot and map as a whole changes no observation, so a filter must never learn where the
/// whole lies. It does learn it if each Jacobian is taken at another estimate. With first estimates, all
/// Jacobians describe this motion about the same points at all times: Huang, Mourikis, Roumeliotis,
/// "Observability-based rules for designing consistent EKF SLAM estimators", IJRR 2010.
///
/// A landmark's first estimate settles (is fixed) after some sightings, or when the landmark gets its first
/// link to a passive landmark. The pose's first estimate is its prediction, transformed into the frame of the
/// first estimates: after a closed loop has moved the map as a whole, the prediction itself would not fit to
/// them. A new landmark's first estimate is computed from that pose for the same reason.
class FirstEstimates {
 public:
  explicit FirstEstimates(const Pose2& start) : pose_(start) {}

  /// From now on a landmark's first estimate settles after `sightings` scans that saw the landmark; at least
  /// one. To be called before the first landmark joins.
  void settle_after(int sightings) { settled_after_ = sightings; }
  bool in_use() const { return settled_after_ > 0; }
  int settled_after() const { return settled_after_; }

  /// The largest standard deviation of a sighting in the latest scan [m], for are_levers_alike(). Before the
  /// first call all first estimates count as alike.
  void note_sighting_sd(double sighting_sd) { sighting_sd_ = sighting_sd; }
  double sighting_sd() const { return sighting_sd_; }

  /// T_world_robot in the frame of the first estimates.
  const Pose2& pose() const { return pose_; }
  void set_pose(const Pose2& pose) { pose_ = pose; }
  /// The first estimate of a landmark, p_world_landmark. [m]
  Eigen::Vector2d point(int slot) const { return points_[static_cast<std::size_t>(slot)]; }
  void set_point(int slot, const Eigen::Vector2d& point) { points_[static_cast<std::size_t>(slot)] = point; }
  /// From the pose to the landmark. [m]
  Eigen::Vector2d lever(int slot) const { return point(slot) - Eigen::Vector2d(pose_.x, pose_.y); }

  /// p_world, shifted by the difference of two poses: from the pose in the frame of the first estimates to the
  /// result is the same vector as from `pose` to p_world. It is not turned as the frame is: the small turns of
  /// many landmarks, each placed by earlier ones, would add up. [m]
  Eigen::Vector2d framed(const Eigen::Vector2d& p_world, const Pose2& pose) const {
    if (!in_use()) return p_world;
    return Eigen::Vector2d(pose_.x, pose_.y) + p_world - Eigen::Vector2d(pose.x, pose.y);
  }

  /// The next landmark joins.
  void add(const Eigen::Vector2d& point) { points_.push_back(point); }

  /// The prediction moves the pose from `before` to `after`. `for_each_active` calls its argument with slot and
  /// mean of each active landmark. Returns by how much the pose in the frame of the first estimates moved. [m]
  template <class ForEachActive>
  Eigen::Vector2d move_pose(const Pose2& before, const Pose2& after, const ForEachActive& for_each_active) {
    gather(for_each_active);
    return move_pose(before, after);
  }

  /// The same when a scan has moved the pose. Nothing moves, and the result is zero, if a landmark does not fit:
  /// then the scan has moved parts of the map, as where a loop closes.
  template <class ForEachActive>
  Eigen::Vector2d follow_pose(const Pose2& before, const Pose2& after, const ForEachActive& for_each_active) {
    gather(for_each_active);
    return follow_pose(before, after);
  }

  /// The robot is put at `at`, among landmarks that are all of one frame.
  template <class ForEachActive>
  void put_pose(const Pose2& at, const ForEachActive& for_each_active) {
    gather(for_each_active);
    put_pose(at);
  }

  std::size_t memory_bytes() const { return points_.memory_bytes(); }

 private:
  template <class ForEachActive>
  void gather(const ForEachActive& for_each_active) {
    active_.clear();
    for_each_active([this](int slot, const Eigen::Vector2d& mean) {
      active_.push_back({mean, point(slot)});
    });
  }
  Eigen::Vector2d move_pose(const Pose2& before, const Pose2& after);
  Eigen::Vector2d follow_pose(const Pose2& before, const Pose2& after);
  void put_pose(const Pose2& at);
  /// How many active landmarks fit to a pose in the frame of the first estimates, with the pose's mean at
  /// `mean`.
  std::size_t fitting(const Pose2& framed, const Pose2& mean) const;

  using Point = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;

  int settled_after_ = 0;  // [-] sightings; 0: not in use
  Pose2 pose_;
  double sighting_sd_ = std::numeric_limits<double>::infinity();  // [m]
  ChunkedArray<Point> points_;                                    // by slot
  std::vector<FirstEstimate> active_;                             // kept so that no update allocates
};

}  // namespace seif
