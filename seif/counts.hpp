// Counts of a filter's work, and of its present state.
#pragma once

#include <cstdint>
#include <optional>

namespace seif {

/// The first group is summed over all updates since the filter was made. The second group describes the present
/// state.
struct Counts {
  std::int64_t blocks_touched = 0;  // [-] blocks of the state read or written
  std::int64_t relocations = 0;     // [-] times the robot was marginalised out and put back
  std::int64_t gated = 0;     // [-] observations of known landmarks that the gate made the filter ignore
  std::int64_t weakened = 0;  // [-] observations of known landmarks that got less weight (robust_above)

  int active_landmarks = 0;  // [-] landmarks with a link to the robot
  std::int64_t links = 0;    // [-] the report's count: links of the robot + pairs of linked landmarks

  // Diagnostics that cost constant time. A filter that does not compute one leaves it empty.

  /// [-] Sum of r_i' Omega_ii^-1 r_i over the blocks i, each with its values when it was last touched. It tells
  /// how far the mean is from the filter's own Omega^-1 xi: divided by one plus the largest degree of a block,
  /// it is a lower bound of r' Omega^-1 r, the squared error of the mean in units of sigma.
  std::optional<double> mean_residual = {};
  /// [nat] Sum of what sparsify() has returned so far: how much anchoring to the world frame the
  /// sparsifications have left out.
  std::optional<double> anchoring = {};
  /// [-] v' S^-1 v of the latest scan. v holds the innovations of all its observations of known landmarks,
  /// without the ignored ones; S is the covariance of v by the belief before the scan. For a consistent filter
  /// this is chi-square distributed with `innovation_degrees` degrees of freedom, and independent from scan to
  /// scan.
  std::optional<double> innovation = {};
  int innovation_degrees = 0;  // [-] two for each observation
};

}  // namespace seif
