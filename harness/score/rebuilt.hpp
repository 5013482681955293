// Scores that need more than the run folder holds. A replay of the run rebuilds them. Definitions:
// docs/scores.md.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "harness/score/score.hpp"
#include "harness/statistics/statistics.hpp"

namespace harness {

/// The innovation of a whole scan.
struct ScanNis {
  double nis = 0.0;  // [-] normalised innovation squared, per degree of freedom
  int degrees = 0;   // [-] degrees of freedom: two for each observation
};

/// A value that is not available is empty.
struct ScanNisScore {
  std::optional<double> nis;               // [-] mean over all degrees of freedom
  std::optional<ConfidenceInterval> band;  // [-] 95 % of such means lie in it
  std::size_t count = 0;                   // [-] number of scans
  std::optional<double> inside;  // [-] share of the scans inside the band of their own degrees of freedom
};

/// The chi-square values of the scans are added up: the innovations of a consistent filter are independent
/// from scan to scan.
ScanNisScore score_scans(std::span<const ScanNis> scans);

/// A value that is not available is empty.
struct RebuiltScore {
  std::optional<double> nis;                             // [-] mean over the observations
  std::size_t observations = 0;                          // [-] observations that have a NIS
  std::optional<double> nis_inside;                      // [-] share of them inside the chi-square band
  ScanNisScore scans;                                    // the same for whole scans
  std::optional<double> nees_landmark_from_robot;        // [-] mean over the scoring times
  std::optional<double> nees_landmark_from_robot_final;  // [-] when the run ends
  std::optional<double> landmarks_from_robot_inside;  // [-] share of the sample inside the band, at the end
};

/// The NEES, per degree of freedom, of a landmark's position in the robot's frame. `joint` is the covariance
/// of the estimated pose and landmark, (5 x 5) in the order [x y theta m_x m_y].
std::optional<double> nees_from_robot(const PosePair& pose, const PointPair& landmark,
                                      const Eigen::Matrix<double, 5, 5>& joint);

}  // namespace harness
