// A symmetric matrix (n x n) stored as its lower triangle, one column after the other.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace seif {

constexpr Eigen::Index packed_size(Eigen::Index n) { return n * (n + 1) / 2; }

/// Where the element (row, col) is, row >= col.
constexpr Eigen::Index packed_index(Eigen::Index n, Eigen::Index row, Eigen::Index col) {
  return col * n - col * (col + 1) / 2 + row;
}

/// Both triangles, to `full` (n x n).
inline void unpack_triangle(const double* packed, Eigen::Ref<Eigen::MatrixXd> full) {
  const Eigen::Index n = full.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    full.col(j).tail(n - j) = Eigen::Map<const Eigen::VectorXd>(packed, n - j);
    full.row(j).tail(n - j) = full.col(j).tail(n - j).transpose();
    packed += n - j;
  }
}

/// The lower triangle of `full` (n x n).
inline void pack_triangle(const Eigen::Ref<const Eigen::MatrixXd>& full, double* packed) {
  const Eigen::Index n = full.rows();
  for (Eigen::Index j = 0; j < n; ++j) packed = std::copy_n(full.col(j).data() + j, n - j, packed);
}

}  // namespace seif
