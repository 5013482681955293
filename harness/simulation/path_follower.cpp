#include "harness/simulation/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace harness {

namespace {

constexpr double arrived = 0.05;           // [m] a stopping place this near is reached
constexpr double begin_turn = 1.2;         // [rad] a target further aside makes the robot turn on the spot
constexpr double end_turn = 0.15;          // [rad] the turn ends when the target is this nearly ahead
constexpr double turn_gain = 2.0;          // [1/s] turn rate for each radian that is left
constexpr double shortest_segment = 1e-3;  // [m] nearer points are merged, which bounds the work of a step
constexpr double slowest = 0.05;           // [m/s] lowest speed before a stop
constexpr double turning_back =
    -0.5;  // [-] cosine of 120 degrees: at a sharper corner the robot stops and turns

}  // namespace

void PathFollower::follow(std::span<const Eigen::Vector2d> points, bool closed,
                          const Eigen::Vector2d& start) {
  points_.clear();
  for (const Eigen::Vector2d& point : points) {
    if (points_.empty() || (point - points_.back()).norm() > shortest_segment) points_.push_back(point);
  }
  closed_ = closed && points_.size() > 2;
  if (closed_ && (points_.front() - points_.back()).norm() > shortest_segment)
    points_.push_back(Eigen::Vector2d(points_.front()));
  is_finished_ = points_.size() < 2;
  is_turning_ = false;
  place_ = closed_ ? nearest_in_all(start) : Place{};
}

double PathFollower::length(std::size_t segment) const {
  return (points_[segment + 1] - points_[segment]).norm();
}

Eigen::Vector2d PathFollower::at(const Place& place) const {
  const Eigen::Vector2d& from = points_[place.segment];
  const Eigen::Vector2d& to = points_[place.segment + 1];
  const double whole = length(place.segment);
  return from + (to - from) * std::min(place.along / whole, 1.0);
}

/// False at the end of an open path.
bool PathFollower::go_to_next_segment(Place& place) const {
  const bool is_last = place.segment + 2 == points_.size();
  if (is_last && !closed_) return false;
  place = {is_last ? 0 : place.segment + 1, 0.0};
  return true;
}

/// True if the robot must stop at the end of this segment, because the path ends there or turns back sharply.
bool PathFollower::turns_back_after(std::size_t segment) const {
  Place next{segment, 0.0};
  if (!go_to_next_segment(next)) return true;
  const Eigen::Vector2d before = points_[segment + 1] - points_[segment];
  const Eigen::Vector2d after = points_[next.segment + 1] - points_[next.segment];
  return before.dot(after) < turning_back * before.norm() * after.norm();
}

PathFollower::Place PathFollower::nearest_in_all(const Eigen::Vector2d& p_world) const {
  Place best;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t segment = 0; segment + 1 < points_.size(); ++segment) {
    const double whole = length(segment);
    const Eigen::Vector2d direction = (points_[segment + 1] - points_[segment]) / whole;
    const double along = std::clamp(direction.dot(p_world - points_[segment]), 0.0, whole);
    const double distance = (points_[segment] + along * direction - p_world).norm();
    if (distance < smallest) {
      smallest = distance;
      best = {segment, along};
    }
  }
  return best;
}

/// Moves the place forward to the path's nearest point within the lookahead.
void PathFollower::advance(const Eigen::Vector2d& p_world) {
  Place probe = place_;
  double smallest = (at(place_) - p_world).norm();
  double left = limits_.lookahead;
  while (left > 0.0) {
    const double whole = length(probe.segment);
    const double last = std::min(whole, probe.along + left);
    const Eigen::Vector2d direction = (points_[probe.segment + 1] - points_[probe.segment]) / whole;
    const double along = std::clamp(direction.dot(p_world - points_[probe.segment]), probe.along, last);
    const double distance = (points_[probe.segment] + along * direction - p_world).norm();
    if (distance < smallest) {
      smallest = distance;
      place_ = {probe.segment, along};
    }
    left -= last - probe.along;
    if (last < whole || turns_back_after(probe.segment) || !go_to_next_segment(probe)) break;
  }
}

/// The target on the path: one lookahead ahead, but not beyond the next place where the robot must stop.
Eigen::Vector2d PathFollower::target(const Eigen::Vector2d& p_world) {
  Place ahead = place_;
  double left = limits_.lookahead;
  to_stop_ = std::numeric_limits<double>::infinity();
  while (true) {
    const double whole = length(ahead.segment);
    if (ahead.along + left < whole) {
      ahead.along += left;
      return at(ahead);
    }
    if (turns_back_after(ahead.segment)) {
      const Eigen::Vector2d& stop = points_[ahead.segment + 1];
      to_stop_ = (stop - p_world).norm();
      if (to_stop_ >= arrived) return stop;
      place_ = ahead;
      is_finished_ = !go_to_next_segment(place_);
      to_stop_ = std::numeric_limits<double>::infinity();
      return is_finished_ ? stop : at({place_.segment, std::min(limits_.lookahead, length(place_.segment))});
    }
    left -= whole - ahead.along;
    go_to_next_segment(ahead);
  }
}

sim::Command PathFollower::command(const seif::Pose2& T_world_robot) {
  if (is_finished_) return {};
  const Eigen::Vector2d p_world(T_world_robot.x, T_world_robot.y);
  advance(p_world);
  const Eigen::Vector2d p_world_target = target(p_world);
  if (is_finished_) return {};
  return steer_to(inverse(T_world_robot) * p_world_target, to_stop_);
}

sim::Command PathFollower::steer_to(const Eigen::Vector2d& p_robot_target, double to_stop) {
  const double aside = std::atan2(p_robot_target.y(), p_robot_target.x());
  is_turning_ = std::abs(aside) > (is_turning_ ? end_turn : begin_turn);
  if (is_turning_) return {0.0, std::clamp(turn_gain * aside, -limits_.turn_rate, limits_.turn_rate)};
  // The circle through the target that is tangent to the heading.
  const double curvature =
      2.0 * p_robot_target.y() / std::max(p_robot_target.squaredNorm(), arrived * arrived);
  const double braking = std::max(slowest, std::sqrt(2.0 * limits_.deceleration * to_stop));
  const double turning = limits_.turn_rate / std::max(std::abs(curvature), limits_.turn_rate / limits_.speed);
  const double v = std::min({limits_.speed, braking, turning});
  return {v, v * curvature};
}

}  // namespace harness
