// Marginal covariances of an information state, off the live path: a sparse Cholesky factorisation and those
// entries of the inverse that lie on the factor's pattern.
#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <span>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/information_state.hpp"

namespace seif {

/// The entries of A^-1 on the pattern of its Cholesky factor, as blocks on the diagonal. Takahashi's
/// recursion: Erisman, Tinney, "On computing certain elements of the inverse of a sparse matrix", CACM 1975.
class DiagonalBlocksOfInverse {
 public:
  /// `A` is symmetric, its lower triangle given. Nothing if it is not positive definite.
  static std::optional<DiagonalBlocksOfInverse> of(const Eigen::SparseMatrix<double>& A);

  /// (A^-1)_ij. The entry A_ij must be stored, zero or not.
  double operator()(int i, int j) const;

  /// The block of A^-1 on the diagonal whose first row is `row`.
  template <int size>
  Eigen::Matrix<double, size, size> block(int row) const {
    Eigen::Matrix<double, size, size> block;
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) block(i, j) = (*this)(row + i, row + j);
    }
    return block;
  }

 private:
  Eigen::SparseMatrix<double> Z_;  // lower triangle, permuted
  Eigen::VectorXi permuted_;       // where row i of A went
};

/// A^-1 at the rows of each block and the same columns, by one factorisation and the ways from these rows up
/// the elimination tree. `A` is symmetric, its lower triangle given. Nothing if it is not positive definite.
std::optional<std::vector<Eigen::MatrixXd>> blocks_of_inverse(const Eigen::SparseMatrix<double>& A,
                                                              std::span<const std::vector<int>> blocks);

/// The rows of [x y theta m1x m1y ...] that a group's joint covariance takes, in its order.
template <class RowOf>
std::vector<int> joint_rows(const LandmarkIds& group, const RowOf& row_of) {
  std::vector<int> rows = {0, 1, 2};
  for (const LandmarkId landmark : group) {
    for (const int i : {0, 1}) rows.push_back(row_of(landmark) + i);
  }
  return rows;
}

/// As Estimator::marginal_covariances. For a few landmarks little more than the factorisation.
std::optional<MarginalCovariances> marginals_of(const InformationState& state,
                                                std::span<const LandmarkId> landmarks);

/// As Estimator::joint_covariances, at the cost that marginals_of() has for a few.
std::optional<std::vector<Eigen::MatrixXd>> joint_covariances_of(const InformationState& state,
                                                                 std::span<const LandmarkIds> groups);

}  // namespace seif
