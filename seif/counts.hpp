// What a filter counts of its own work and state.
#pragma once

#include <cstdint>
#include <optional>

namespace seif {

/// The first group sums over all updates since the filter was made; the second says what it holds now.
struct Counts {
  std::int64_t blocks_touched = 0;  // [-] blocks of the state read or written
  std::int64_t relocations = 0;     // [-] times the robot was marginalised out and put back
  std::int64_t gated = 0;           // [-] observations of known landmarks that the gate ignored
  std::int64_t weakened = 0;        // [-] observations of known landmarks that got less weight

  int active_landmarks = 0;  // [-] landmarks with a link to the robot
  std::int64_t links = 0;    // [-] the report's count: links of the robot + pairs of linked landmarks

  // Diagnostics that cost constant time; nothing from filters that do not have them.

  /// [-] Sum of r_i' Omega_ii^-1 r_i over blocks i, each as it was when last touched: how far the mean is from
  /// the filter's own Omega^-1 xi. Divided by one plus the largest degree of a block, it bounds the squared
  /// error of the mean in units of sigma, r' Omega^-1 r, from below.
  std::optional<double> mean_residual = {};
  /// [nat] Anchoring to the world frame that the sparsifications so far have left out, as sparsify() returns it.
  std::optional<double> anchoring = {};
  /// [-] v' S^-1 v of the latest scan: of all its observations of known landmarks together, without those that
  /// the gate ignored, by the belief before the scan. For a consistent filter it is chi-square distributed with
  /// `innovation_degrees` degrees of freedom, and independent from scan to scan.
  std::optional<double> innovation = {};
  int innovation_degrees = 0;  // [-] two for each observation
};

}  // namespace seif
