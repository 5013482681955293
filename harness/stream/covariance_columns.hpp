// Covariances in the columns of a table: upper triangles, row by row.
#pragma once

#include <Eigen/Core>

#include "harness/files/csv_reader.hpp"

namespace harness {

/// The covariance whose first number stands in `column`, from size (size + 1) / 2 columns. Throws BadInput.
template <int size>
Eigen::Matrix<double, size, size> read_covariance(const CsvReader& rows, int column) {
  Eigen::Matrix<double, size, size> covariance;
  for (int i = 0; i < size; ++i) {
    for (int j = i; j < size; ++j) covariance(i, j) = covariance(j, i) = rows.number(column++);
  }
  return covariance;
}

}  // namespace harness
