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

/// The lower triangle, to that of `full` (n x n).
inline void unpack_lower_triangle(const double* packed, Eigen::Ref<Eigen::MatrixXd> full) {
  const Eigen::Index n = full.rows();
  for (Eigen::Index j = 0; j < n; packed += n - j, ++j) std::copy_n(packed, n - j, full.col(j).data() + j);
}

/// Of a matrix whose lower triangle is known (n x n).
inline void fill_upper_triangle(Eigen::Ref<Eigen::MatrixXd> full) {
  const Eigen::Index n = full.rows();
  for (Eigen::Index j = 0; j < n; ++j) full.row(j).tail(n - j) = full.col(j).tail(n - j).transpose();
}

/// Both triangles, to `full` (n x n).
inline void unpack_triangle(const double* packed, Eigen::Ref<Eigen::MatrixXd> full) {
  unpack_lower_triangle(packed, full);
  fill_upper_triangle(full);
}

/// The lower triangle of `full` (n x n).
inline void pack_triangle(const Eigen::Ref<const Eigen::MatrixXd>& full, double* packed) {
  const Eigen::Index n = full.rows();
  for (Eigen::Index j = 0; j < n; ++j) packed = std::copy_n(full.col(j).data() + j, n - j, packed);
}

}  // namespace seif
