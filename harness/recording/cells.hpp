// Cells that several tables of a run folder have in common.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "harness/files/csv_writer.hpp"

namespace harness {

/// The upper triangle, row by row.
template <class Matrix>
void write_covariance(CsvWriter& file, const Matrix& covariance) {
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = i; j < covariance.cols(); ++j) file.value(covariance(i, j));
  }
}

/// Writes the number, or an empty cell if it is not known.
inline void write_if_known(CsvWriter& file, const std::optional<double>& number) {
  number ? file.value(*number) : file.leave_empty();
}

}  // namespace harness
