#include "harness/readers/velocity_log.hpp"

#include <algorithm>
#include <cmath>

#include "harness/readers/landmark_rows.hpp"
#include "sensors/wheel_arc.hpp"

namespace harness {

namespace {

constexpr double longest_hold = 0.5;  // [s] rows come every few hundredths of a second; more is a gap

/// The arc of a robot with two wheels one metre apart.
seif::Pose2 arc(const VelocityRow& velocity, double duration) {
  const double way = velocity.v * duration;
  const double half_turn = 0.5 * velocity.omega * duration;
  return sensors::wheel_arc({way - half_turn, way + half_turn}, 1.0).T_start_end;
}

}  // namespace

double VelocityLog::since_start(double t) const {
  constexpr double steps_per_s = 1e6;
  return std::round((t - zero_) * steps_per_s) / steps_per_s;
}

void VelocityLog::begin() {
  truth_ = TruthTrack(description_.longest_truth_gap);
  const std::optional<VelocityRow> first = read_velocity();
  if (!first) return;
  zero_ = first->t;
  now_ = *first;
  now_.t = 0.0;
  advance_velocity();
  next_observation_ = read_observation();
  description_.true_start = truth_at(0.0);
}

void VelocityLog::advance_velocity() {
  next_velocity_ = read_velocity();
  if (!next_velocity_) return;
  next_velocity_->t = since_start(next_velocity_->t);
  if (next_velocity_->t - now_.t > longest_hold) ++counts_.odometry_gaps;
}

std::optional<TruePose> VelocityLog::truth_at(double t) {
  return truth_.at(t, [this] {
    std::optional<TruePose> row = read_truth();
    if (row) row->t = since_start(row->t);
    return row;
  });
}

bool VelocityLog::next(Event& event) {
  while (next_velocity_ && next_velocity_->t <= t_) {  // of several rows with the same time the last counts
    now_ = *next_velocity_;
    advance_velocity();
  }
  leave_out_what_nothing_leads_to();
  if (next_observation_ && since_start(next_observation_->t) == t_) {
    fill(memory_.scan(event));
    return true;
  }
  if (!next_velocity_) return false;
  const double to =
      next_observation_ ? std::min(since_start(next_observation_->t), next_velocity_->t) : next_velocity_->t;
  OdometryEvent& odometry = memory_.odometry(event);
  odometry.odometry = {to, arc(now_, to - t_), Eigen::Matrix3d::Zero()};
  odometry.truth = truth_at(to);
  t_ = to;
  return true;
}

/// Leaves out observations before the first velocity and after the last one.
void VelocityLog::leave_out_what_nothing_leads_to() {
  const auto is_outside = [this](double t) { return t < 0.0 || (t > t_ && !next_velocity_); };
  while (next_observation_ && is_outside(since_start(next_observation_->t))) {
    ++counts_.without_odometry;
    next_observation_ = read_observation();
  }
}

/// Gathers the observations with the same time into one scan.
void VelocityLog::fill(ScanEvent& event) {
  begin_scan(event, t_, truth_at(t_));
  for (; next_observation_ && since_start(next_observation_->t) == t_; next_observation_ = read_observation())
    add_once(next_observation_->observation, event, counts_);
}

}  // namespace harness
