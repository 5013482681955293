#include "seif/full_state.hpp"

#include <vector>

namespace seif {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

/// The entries of a block that lie in the lower triangle.
template <class Block>
void add_block(int row, int col, const Block& block, Entries& entries) {
  for (int i = 0; i < block.rows(); ++i) {
    for (int j = 0; j < block.cols(); ++j) {
      if (row + i >= col + j) entries.emplace_back(row + i, col + j, block(i, j));
    }
  }
}

/// Without the blocks of single landmarks.
void add_window(const InformationState& state, const Eigen::MatrixXd& Omega, Entries& entries) {
  const auto row_of = [](int i) { return InformationState::row_of(i); };
  add_block(0, 0, Omega.topLeftCorner<3, 3>(), entries);
  for (int p = 0; p < state.active_count(); ++p) {
    const int slot = state.active(p);
    add_block(row_of(slot), 0, Omega.block<2, 3>(row_of(p), 0), entries);
    for (int q = 0; q < state.active_count(); ++q) {
      const int other = state.active(q);
      if (other < slot)
        add_block(row_of(slot), row_of(other), Omega.block<2, 2>(row_of(p), row_of(q)), entries);
    }
  }
}

}  // namespace

std::vector<Eigen::Triplet<double>> window_entries(const InformationState& state) {
  Entries entries;
  add_window(state, state.Omega(), entries);
  for (int p = 0; p < state.active_count(); ++p) {
    const int row = InformationState::row_of(p);
    const int to = InformationState::row_of(state.active(p));
    add_block(to, to, state.Omega().block<2, 2>(row, row), entries);
  }
  return entries;
}

Eigen::SparseMatrix<double> full_Omega(const InformationState& state) {
  Entries entries;
  const auto row_of = [](int slot) { return InformationState::row_of(slot); };
  add_window(state, state.Omega() + state.frozen(), entries);
  for (int slot = 0; slot < state.landmark_count(); ++slot) {
    add_block(row_of(slot), row_of(slot), state.information(slot), entries);
    state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
      if (other < slot) add_block(row_of(slot), row_of(other), Omega_so, entries);
    });
  }
  const int size = row_of(state.landmark_count());
  Eigen::SparseMatrix<double> Omega(size, size);
  Omega.setFromTriplets(entries.begin(), entries.end());
  return Omega;
}

Eigen::VectorXd full_mu(const InformationState& state) {
  Eigen::VectorXd mu(InformationState::row_of(state.landmark_count()));
  const Pose2 pose = state.pose();
  mu.head<3>() << pose.x, pose.y, pose.theta;
  for (int slot = 0; slot < state.landmark_count(); ++slot)
    mu.segment<2>(InformationState::row_of(slot)) = state.mean(slot);
  return mu;
}

Eigen::VectorXd full_r(const InformationState& state) {
  Eigen::VectorXd r(InformationState::row_of(state.landmark_count()));
  r.head<3>() = state.r().head<3>();
  for (int slot = 0; slot < state.landmark_count(); ++slot)
    r.segment<2>(InformationState::row_of(slot)) = state.residual(slot);
  return r;
}

void move_all(InformationState& state, const Eigen::VectorXd& d) {
  state.move_robot(d.head<3>());
  for (int slot = 0; slot < state.landmark_count(); ++slot)
    state.move_landmark(slot, d.segment<2>(InformationState::row_of(slot)));
}

}  // namespace seif
