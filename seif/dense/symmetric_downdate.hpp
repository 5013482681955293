// Sigma -= W W' on one triangle: the step in which a dense EKF spends its time.
#pragma once

#include <Eigen/Core>

#include "seif/aligned_numbers.hpp"

namespace seif {

/// For a W of few columns against many rows (a scan's observations against the map). About 1.5 times as fast
/// as Eigen's rankUpdate, which is made for many columns: each tile of Sigma is read and written once, and W
/// is stored in the order in which it is read.
class SymmetricDowndate {
 public:
  static constexpr int tile = 8;  // [-] rows and columns

  /// Subtracts W W' (n x n) from the lower triangle of the first n rows and columns of Sigma. Sigma must have
  /// a multiple of `tile` rows, and columns, not less than n. Entries above the diagonal and beyond n may
  /// be overwritten.
  void operator()(Eigen::MatrixXd& Sigma, const Eigen::Ref<const Eigen::MatrixXd>& W);

 private:
  AlignedNumbers by_rows_;  // W in tiles of rows, each column by column; zero beyond n
};

}  // namespace seif
