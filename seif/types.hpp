// Poses, measurements and landmark names: what every estimator takes in.
//
// Frames: world x east, y north; robot x forward, y left; yaw and bearing counter-clockwise.
// Units: metres, seconds, radians. State order [x y theta m1x m1y m2x m2y ...].
//
// Glossary         code              Thrun et al. 2002     Probabilistic Robotics
//   mean           mu                mu                    mu
//   information    Omega, xi         H, b                  Omega, xi
//   residual       r = xi - Omega mu -                     -
//   motion noise   R = L L'          U                     R
//   sensor noise   Q                 Z                     Q
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace seif {

using LandmarkId = std::int32_t;  // >= 0; given by the sensor, the report's known correspondence
inline constexpr LandmarkId no_landmark = -1;

/// The same angle in (-pi, pi]. [rad]
double wrap_angle(double angle);

/// A rigid transform of the plane: T_a_b takes points of frame b into frame a.
struct Pose2 {
  double x = 0.0;      // [m]
  double y = 0.0;      // [m]
  double theta = 0.0;  // [rad], in (-pi, pi]
};

/// T_a_c = T_a_b * T_b_c.
Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c);

/// p_a = T_a_b * p_b.
Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b);

Pose2 inverse(const Pose2& T_a_b);

/// A pose and its covariance.
struct PoseEstimate {
  Pose2 mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // (3 x 3) of [x y theta] [m, rad]
};

/// The motion of the robot since the previous odometry, measured by its wheel encoders.
struct Odometry {
  double t = 0.0;            // [s] at the end of the increment
  Pose2 T_previous_current;  // the increment, in the robot frame of the previous one
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // (3 x 3) of the increment, same frame; any rank
};

/// One landmark as the sensor saw it: range and bearing to its centre, in the sensor frame.
struct Observation {
  LandmarkId landmark = no_landmark;
  double range = 0.0;                                    // [m]
  double bearing = 0.0;                                  // [rad]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // (2 x 2) of [range bearing]; positive definite
};

/// All observations of one moment; may be empty.
struct Scan {
  double t = 0.0;  // [s]
  std::vector<Observation> observations;
};

}  // namespace seif
