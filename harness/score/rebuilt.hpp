// Scores that need more than the files of a run: a replay rebuilds what is missing. Definitions: docs/scores.md.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "harness/score/score.hpp"
#include "harness/statistics/statistics.hpp"

namespace harness {

/// The innovation of a scan as a whole.
struct ScanNis {
  double nis = 0.0;  // [-] for each degree of freedom
  int degrees = 0;   // [-] of freedom: two for each observation
};

/// What is not available is nothing.
struct ScanNisScore {
  std::optional<double> nis;               // [-] mean over the degrees of freedom
  std::optional<ConfidenceInterval> band;  // [-] where 95 % of these means lie
  std::size_t count = 0;                   // [-] scans
  std::optional<double> inside;  // [-] share of them, each in the band of its own degrees of freedom
};

/// The innovations of a consistent filter are independent from scan to scan, so their chi-square values add up.
ScanNisScore score_scans(std::span<const ScanNis> scans);

/// What is not available is nothing.
struct RebuiltScore {
  std::optional<double> nis;                             // [-] mean over the observations
  std::size_t observations = 0;                          // [-] that have one
  std::optional<double> nis_inside;                      // [-] share of them inside the chi-square band
  ScanNisScore scans;                                    // the same by whole scans
  std::optional<double> nees_landmark_from_robot;        // [-] mean over the scoring times
  std::optional<double> nees_landmark_from_robot_final;  // [-]
  std::optional<double> landmarks_from_robot_inside;  // [-] at the end, share of the sample inside the band
};

/// The NEES per degree of freedom of where a landmark is as seen from the robot. `joint` is the covariance of
/// the estimated pose and landmark, (5 x 5) of [x y theta m_x m_y].
std::optional<double> nees_from_robot(const PosePair& pose, const PointPair& landmark,
                                      const Eigen::Matrix<double, 5, 5>& joint);

}  // namespace harness
