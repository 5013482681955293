#include "seif/tree/body_motion.hpp"

#include <cmath>
#include <numbers>

namespace seif {
namespace {

void set_turn(const BodyFit::Turn& turn, BodyMotion& motion) {
  motion.angle = std::atan2(turn.cross, turn.dot);
  motion.R << std::cos(motion.angle), -std::sin(motion.angle), std::sin(motion.angle), std::cos(motion.angle);
}

}  // namespace

void BodyFit::Turn::add(const Eigen::Vector2d& before, const Eigen::Vector2d& now, double weight) {
  dot += weight * before.dot(now);
  cross += weight * (before.x() * now.y() - before.y() * now.x());
}

void BodyFit::begin(double near) {
  squared_near_ = near * near;
  points_.clear();
  clusters_.clear();
  known_ = {};
}

void BodyFit::add(const Eigen::Vector2d& p_before, const Eigen::Vector2d& p_now) {
  int cluster = none;
  for (const Point& other : points_) {
    if (other.cluster == none || !are_together(other, p_before, p_now)) continue;
    if (cluster == none) cluster = other.cluster;
    if (other.cluster != cluster) join(other.cluster, cluster);
  }
  if (cluster == none) {
    cluster = static_cast<int>(clusters_.size());
    clusters_.emplace_back();
  }
  points_.push_back({p_before, p_now, cluster});
}

/// Two ends of a map that lie side by side by chance, until a closure moves one, are not together: as one body they
/// would have turned by a large angle.
bool BodyFit::are_together(const Point& point, const Eigen::Vector2d& p_before,
                           const Eigen::Vector2d& p_now) const {
  const double before = (p_before - point.before).squaredNorm();
  const double now = (p_now - point.now).squaredNorm();
  if (before >= squared_near_ || now >= squared_near_) return false;
  constexpr double most_stretch = 0.02;  // [-] of the distance that is near
  constexpr double most_turn = 0.5;      // [rad]
  const double apart = ((p_now - p_before) - (point.now - point.before)).squaredNorm();
  return std::abs(std::sqrt(before) - std::sqrt(now)) <= most_stretch * std::sqrt(squared_near_) &&
         apart <= most_turn * most_turn * before;
}

void BodyFit::add_turned(const Eigen::Vector2d& p_before, const Eigen::Vector2d& p_now, double angle) {
  points_.push_back({p_before, p_now, none});
  known_.add(Eigen::Vector2d::UnitX(), {std::cos(angle), std::sin(angle)}, weight_of_turn);
}

void BodyFit::join(int from, int to) {
  for (Point& point : points_) {
    if (point.cluster == from) point.cluster = to;
  }
}

const BodyMotion& BodyFit::fit() {
  motion_ = {};
  for (Cluster& cluster : clusters_) cluster = {};
  if (points_.empty()) return motion_;
  find_middles();
  find_turns();
  return motion_;
}

void BodyFit::find_middles() {
  for (const Point& point : points_) {
    motion_.before += point.before;
    motion_.now += point.now;
    if (point.cluster == none) continue;
    Cluster& cluster = clusters_[static_cast<std::size_t>(point.cluster)];
    ++cluster.points;
    cluster.motion.before += point.before;
    cluster.motion.now += point.now;
  }
  motion_.before /= static_cast<double>(points_.size());
  motion_.now /= static_cast<double>(points_.size());
  for (Cluster& cluster : clusters_) {
    if (cluster.points == 0) continue;
    cluster.motion.before /= cluster.points;
    cluster.motion.now /= cluster.points;
  }
}

void BodyFit::find_turns() {
  Turn of_whole;
  for (const Point& point : points_) {
    of_whole.add(point.before - motion_.before, point.now - motion_.now);
    if (point.cluster == none) continue;
    Cluster& cluster = clusters_[static_cast<std::size_t>(point.cluster)];
    cluster.turn.add(point.before - cluster.motion.before, point.now - cluster.motion.now);
  }
  Turn of_parts = known_;
  for (Cluster& cluster : clusters_) {
    if (!cluster.turn.is_known()) continue;
    of_parts.dot += cluster.turn.dot;
    of_parts.cross += cluster.turn.cross;
    set_turn(cluster.turn, cluster.motion);
  }
  const bool is_one_cluster =
      !points_.empty() && points_.front().cluster != none &&
      clusters_[static_cast<std::size_t>(points_.front().cluster)].points == static_cast<int>(points_.size());
  by_clusters_ = of_parts.is_known() && !is_one_cluster;
  const Turn& turn = by_clusters_ ? of_parts : of_whole;
  if (turn.is_known()) set_turn(turn, motion_);
}

const BodyFit::Cluster* BodyFit::cluster_of(const Point& point) const {
  if (!by_clusters_ || point.cluster == none) return nullptr;
  const Cluster& cluster = clusters_[static_cast<std::size_t>(point.cluster)];
  return cluster.turn.is_known() ? &cluster : nullptr;
}

Eigen::Vector2d BodyFit::step(std::size_t i) const {
  const Point& point = points_[i];
  const Cluster* const cluster = cluster_of(point);
  if (cluster == nullptr) return motion_.step(point.before, point.now);
  const Eigen::Vector2d lever = point.before - cluster->motion.before;
  const double turn = std::remainder(cluster->motion.angle - motion_.angle, 2.0 * std::numbers::pi);
  return cluster->motion.step(point.before, point.now) + turn * Eigen::Vector2d(-lever.y(), lever.x()) +
         motion_.step(cluster->motion.before, cluster->motion.now);
}

}  // namespace seif
