// The Cholesky factor of the last solution for the window. The covariance of the window can be computed from
// it.
#pragma once

#include <Eigen/Core>

namespace seif {

/// The lower triangular L of L L' = Omega over the window, with what is known of all other landmarks added.
/// Valid until the window or its information changes.
struct WindowFactor {
  Eigen::MatrixXd storage;       // L in its upper left corner, with room to grow
  Eigen::Index size = 0;         // [-] w, rows of the window
  double chi_square_drop = 0.0;  // [-] r' (L L')^-1 r: by how much the step lowered the squared error

  auto L() { return storage.topLeftCorner(size, size); }        // (w x w)
  auto L() const { return storage.topLeftCorner(size, size); }  // (w x w)
};

}  // namespace seif
