#include "seif/mean_recovery.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include "seif/full_state.hpp"

namespace seif {
namespace {

bool relax_landmark(InformationState& state, int slot) {
  const Eigen::LLT<Eigen::Matrix2d> llt(state.information(slot));
  if (llt.info() != Eigen::Success) return false;
  state.move_landmark(slot, llt.solve(state.residual(slot)));
  return true;
}

bool relax_robot(InformationState& state) {
  const Eigen::LLT<Eigen::Matrix3d> llt(Eigen::Matrix3d(state.Omega().topLeftCorner<3, 3>()));
  if (llt.info() != Eigen::Success) return false;
  state.move_robot(llt.solve(state.r().head<3>()));
  return true;
}

/// Factorises M = L L' in place; L is then in the lower triangle. False if M is not positive definite.
bool factorise_in_place(Eigen::Ref<Eigen::MatrixXd> M) {
  return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(M).info() == Eigen::Success;
}

}  // namespace

bool coordinate_descent(InformationState& state, int random_landmarks, std::mt19937_64& random) {
  for (int position = 0; position < state.active_count(); ++position) {
    if (!relax_landmark(state, state.active(position))) return false;
  }
  if (state.landmark_count() > 0) {
    std::uniform_int_distribution<int> any_landmark(0, state.landmark_count() - 1);
    for (int k = 0; k < random_landmarks; ++k) {
      if (!relax_landmark(state, any_landmark(random))) return false;
    }
  }
  return relax_robot(state);
}

bool solve_for_window(InformationState& state, Eigen::Ref<Eigen::VectorXd> d) {
  auto L = state.work();
  L = state.Omega();
  if (!factorise_in_place(L)) return false;
  L.triangularView<Eigen::Lower>().solveInPlace(d);
  L.triangularView<Eigen::Lower>().transpose().solveInPlace(d);
  state.touch(state.window_blocks());
  return true;
}

bool solve_mean(InformationState& state) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt(full_Omega(state));
  if (llt.info() != Eigen::Success) return false;
  move_all(state, llt.solve(full_r(state)));
  return true;
}

}  // namespace seif
