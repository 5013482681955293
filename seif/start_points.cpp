#include "seif/start_points.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace seif {

void relate_to_start(InformationState& state, const Eigen::Matrix3d& covariance) {
  const Pose2 start = state.pose();
  const Eigen::Vector2d ahead(std::cos(start.theta), std::sin(start.theta));
  const Eigen::Vector2d at(start.x, start.y);
  for (const LandmarkId id : start_points)
    state.activate(state.add_landmark(id, id == start_points.front() ? at : Eigen::Vector2d(at + ahead)));
  // [p_robot - a, theta - direction of (b - a)], with rows [x y theta a b]
  Eigen::Matrix<double, 3, 7> J = Eigen::Matrix<double, 3, 7>::Zero();
  J.leftCols<3>().setIdentity();
  J.block<2, 2>(0, 3) = -Eigen::Matrix2d::Identity();
  const Eigen::RowVector2d left(-ahead.y(), ahead.x());
  J.block<1, 2>(2, 3) = left;
  J.block<1, 2>(2, 5) = -left;
  state.Omega() = J.transpose() * Eigen::LLT<Eigen::Matrix3d>(covariance).solve(J);
  Eigen::Vector<double, 7>
      apart;  // the distance of the points: known as well, so that no direction is without information
  apart << Eigen::Vector3d::Zero(), -ahead, ahead;
  state.Omega() += apart * apart.transpose() / covariance.topLeftCorner<2, 2>().trace();
}

int active_start_points(const InformationState& state) {
  if (state.landmark_count() == 0 || !is_start_point(state.id(0))) return 0;
  return (state.position(0) >= 0 ? 1 : 0) + (state.position(1) >= 0 ? 1 : 0);
}

Counts without_start_points(const InformationState& state, Counts counts) {
  if (state.landmark_count() == 0 || !is_start_point(state.id(0))) return counts;
  const auto row_of = [&](int slot) { return InformationState::row_of(state.position(slot)); };
  const auto is_linked_in_window = [&](int a, int b) {
    return !state.Omega().block<2, 2>(row_of(a), row_of(b)).isZero(0.0) ||
           !state.frozen().block<2, 2>(row_of(a), row_of(b)).isZero(0.0);
  };
  for (const int slot : {0, 1}) {
    // The pair of start points counts once, with the second.
    const auto count = [&](int other) { counts.links -= slot == 1 || other > 1 ? 1 : 0; };
    state.for_each_neighbour(slot, [&](int other, const auto&) { count(other); });
    if (state.position(slot) < 0) continue;
    --counts.active_landmarks;
    --counts.links;  // to the robot
    for (int p = 0; p < state.active_count(); ++p) {
      const int other = state.active(p);
      if (other != slot && is_linked_in_window(slot, other)) count(other);
    }
  }
  return counts;
}

}  // namespace seif
