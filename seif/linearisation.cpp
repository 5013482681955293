#include "seif/linearisation.hpp"

#include <Eigen/Geometry>

#include "seif/tree/moved_boundary.hpp"

namespace seif {
namespace {

Eigen::Vector2d p_world_robot(const InformationState& state) { return {state.pose().x, state.pose().y}; }

/// A change of variables: turning the pose by dtheta now also moves what stands in `row` by J (-by) dtheta, with
/// J a quarter turn. Omega held no information about turning everything about a first estimate; afterwards it
/// holds none about turning everything about that first estimate moved by `by`.
void change_turn(InformationState& state, int row, const Eigen::Vector2d& by) {
  auto Omega = state.Omega();
  auto r = state.r();
  Omega.col(2) += by.y() * Omega.col(row) - by.x() * Omega.col(row + 1);
  Omega.row(2) += by.y() * Omega.row(row) - by.x() * Omega.row(row + 1);
  r(2) += by.y() * r(row) - by.x() * r(row + 1);
  state.touch(state.active_count() + 1);
}

void move_first_estimate(InformationState& state, int position, const Eigen::Vector2d& to) {
  FirstEstimates& firsts = state.first_estimates();
  const int slot = state.active(position);
  change_turn(state, InformationState::row_of(position), to - firsts.point(slot));
  firsts.set_point(slot, to);
}

bool has_information(const InformationState& state, int position) {
  const int row = InformationState::row_of(position);
  return state.Omega().block<2, 2>(row, row).trace() > 0.0;
}

void turn_frozen(InformationState& state, const Eigen::Matrix2d& R) {
  auto frozen = state.frozen();
  for (int position = 0; position < state.active_count(); ++position) {
    const int row = InformationState::row_of(position);
    for (Eigen::Index k = 0; k < frozen.cols(); ++k)
      frozen.block<2, 1>(row, k) = (R * frozen.block<2, 1>(row, k)).eval();
    for (Eigen::Index k = 0; k < frozen.rows(); ++k)
      frozen.block<1, 2>(k, row) = (frozen.block<1, 2>(k, row) * R.transpose()).eval();
  }
}

/// Calls visit(slot, mean) for each active landmark.
auto active_means(const InformationState& state) {
  return [&state](const auto& visit) {
    for (int position = 0; position < state.active_count(); ++position)
      visit(state.active(position), state.mean(state.active(position)));
  };
}

}  // namespace

Pose2 linearisation_pose(const InformationState& state) {
  return state.first_estimates().in_use() ? state.first_estimates().pose() : state.pose();
}

Eigen::Vector2d linearisation_point(const InformationState& state, int slot) {
  return state.first_estimates().in_use() ? state.first_estimates().point(slot) : state.mean(slot);
}

Eigen::Vector2d lever(const InformationState& state, int slot, const Eigen::Vector2d& p_world_landmark) {
  const FirstEstimates& firsts = state.first_estimates();
  Eigen::Vector2d lever = p_world_landmark - p_world_robot(state);
  if (!firsts.in_use()) return lever;
  const Eigen::Vector2d first = firsts.lever(slot);
  return are_levers_alike(first, lever, firsts.sighting_sd()) ? first : lever;
}

std::optional<Pose2> other_linearisation_pose(const InformationState& state) {
  const FirstEstimates& firsts = state.first_estimates();
  if (!firsts.in_use()) return std::nullopt;
  for (int position = 0; position < state.active_count(); ++position) {
    const int slot = state.active(position);
    const Eigen::Vector2d lever = state.mean(slot) - p_world_robot(state);
    if (are_levers_alike(firsts.lever(slot), lever, firsts.sighting_sd())) continue;
    const Eigen::Vector2d p = firsts.point(slot) - lever;
    return Pose2{p.x(), p.y(), firsts.pose().theta};
  }
  return std::nullopt;
}

Eigen::Vector2d move_to_prediction(InformationState& state, const Pose2& prediction) {
  const Pose2 before = state.pose();
  state.set_pose(prediction);
  if (!state.first_estimates().in_use()) return {prediction.x - before.x, prediction.y - before.y};

  return state.first_estimates().move_pose(before, prediction, active_means(state));
}

void follow_pose(InformationState& state, const Pose2& before) {
  if (!state.first_estimates().in_use()) return;
  change_turn(state, 0, state.first_estimates().follow_pose(before, state.pose(), active_means(state)));
}

void put_robot(InformationState& state, const Pose2& at) {
  state.set_pose(at);
  if (state.first_estimates().in_use()) state.first_estimates().put_pose(at, active_means(state));
}

void carry_first_estimates(InformationState& state, const Turning& turning, MovedBoundary& moved) {
  FirstEstimates& firsts = state.first_estimates();
  const Pose2 from = firsts.pose();
  const Pose2 to = state.pose();
  const Eigen::Vector2d from_p(from.x, from.y);
  const Eigen::Vector2d to_p(to.x, to.y);
  const Eigen::Rotation2Dd R(wrap_angle(to.theta - from.theta));
  moved.begin(turning);
  moved.add({.before = from_p, .now = to_p, .turn = R.angle(), .rows = 3});
  for (int position = 0; position < state.active_count(); ++position) {
    const int slot = state.active(position);
    if (!has_information(state, position)) {
      moved.skip();
      continue;
    }
    const Eigen::Vector2d lever = R.inverse() * (state.mean(slot) - to_p);
    const bool fits = are_levers_alike(firsts.lever(slot), lever, firsts.sighting_sd());
    moved.add({.before = fits ? firsts.point(slot) : from_p + lever, .now = state.mean(slot)});
  }
  moved.fit();
  moved.bring(state.Omega());
  moved.bring_residual(state.r());
  turn_frozen(state, R.toRotationMatrix());
  firsts.set_pose(to);
  for (int position = 0; position < state.active_count(); ++position)
    firsts.set_point(state.active(position), state.mean(state.active(position)));
}

/// A first estimate settles with its landmark's first link to a passive landmark: a later move of it would link
/// the pose to that passive landmark.
void update_first_estimates(InformationState& state) {
  const FirstEstimates& firsts = state.first_estimates();
  for (int position = 0; position < state.active_count(); ++position) {
    const int slot = state.active(position);
    if (state.sightings(slot) > firsts.settled_after() || state.has_link(slot)) continue;
    move_first_estimate(state, position, firsts.framed(state.mean(slot), state.pose()));
  }
}

}  // namespace seif
