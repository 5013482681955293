// Marginal covariances of an information state, off the live path. They come from a sparse Cholesky
// factorisation, and from those entries of the inverse that lie on the pattern of the factor (where the factor
// is not zero).
#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <span>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/information_state.hpp"

namespace seif {

/// For each block: A^-1 at the block's rows and the same columns. Takes one factorisation, and for each of
/// these rows the path up the elimination tree. `A` is symmetric, its lower triangle given. Nothing if it is
/// not positive definite.
std::optional<std::vector<Eigen::MatrixXd>> blocks_of_inverse(const Eigen::SparseMatrix<double>& A,
                                                              std::span<const std::vector<int>> blocks);

/// The marginals of an information matrix `Omega`, its lower triangle given: of the pose whose first row is
/// `pose_row`, and of the landmarks whose first rows are `landmark_rows`. The entries of these blocks must be
/// stored, zero or not. For few landmarks it is blocks_of_inverse(). For many it inverts on the whole pattern of
/// the factor, by Takahashi's recursion: Erisman, Tinney, "On computing certain elements of the inverse of a
/// sparse matrix", CACM 1975. Nothing if Omega is not positive definite.
std::optional<MarginalCovariances> marginals_of(const Eigen::SparseMatrix<double>& Omega, int pose_row,
                                                std::span<const int> landmark_rows);

/// The rows of [x y theta m1x m1y ...] of which a group's joint covariance consists, in its order.
template <class RowOf>
std::vector<int> joint_rows(const LandmarkIds& group, const RowOf& row_of) {
  std::vector<int> rows = {0, 1, 2};
  for (const LandmarkId landmark : group) {
    for (const int i : {0, 1}) rows.push_back(row_of(landmark) + i);
  }
  return rows;
}

/// See Estimator::marginal_covariances. For a few landmarks the cost is little more than the factorisation.
std::optional<MarginalCovariances> marginals_of(const InformationState& state,
                                                std::span<const LandmarkId> landmarks);

/// See Estimator::joint_covariances. The cost is that of marginals_of() for a few landmarks.
std::optional<std::vector<Eigen::MatrixXd>> joint_covariances_of(const InformationState& state,
                                                                 std::span<const LandmarkIds> groups);

}  // namespace seif
