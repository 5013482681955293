// Limits of the covariances in logs. A filter calculates with 16 digits; beyond these limits they do not
// suffice for the smallest and the largest error together, and the filter fails.
#pragma once

#include <Eigen/Core>
#include <string>

namespace harness {

inline constexpr double least_sd = 1e-7;               // [m, rad]
inline constexpr double largest_observation_sd = 1e3;  // [m, rad]

/// Why no filter can work with the covariance of an observation, (2 x 2) [m, rad]; empty if one can. It
/// must be positive definite, with standard deviations of 1e-7 to 1e3 m or rad.
std::string problem_of_observation(const Eigen::Matrix2d& covariance);

/// The same for the covariance of the pose at the start, (3 x 3) [m, rad]: of 1e-7 to 1e4 m or rad.
std::string problem_of_start(const Eigen::Matrix3d& covariance);

/// The same for the covariance of a motion, (3 x 3) [m, rad], of any rank: at most 1e4 m or rad.
std::string problem_of_motion(const Eigen::Matrix3d& covariance);

}  // namespace harness
