// One linearised observation: what it adds to the information form, and how to take exactly that out again.
#pragma once

#include <Eigen/Core>

#include "seif/information_state.hpp"
#include "seif/models.hpp"
#include "seif/types.hpp"

namespace seif {

/// The linear equation J_x (x - x0) + J_m (m - m0) = v for pose x and landmark m, with noise of covariance Q.
struct ObservationFactor {
  int slot = -1;
  Observation observation;
  Matrix23 J_x = Matrix23::Zero();                      // (2 x 3)
  Eigen::Matrix2d J_m = Eigen::Matrix2d::Zero();        // (2 x 2)
  Eigen::Vector2d v = Eigen::Vector2d::Zero();          // innovation at x0, m0 [m, rad]
  Eigen::Matrix2d Q_inverse = Eigen::Matrix2d::Zero();  // (2 x 2)
  Eigen::Vector2d noise = Eigen::Vector2d::Zero();  // variances that Q has beyond the sensor's [m^2, rad^2]
  bool at_measurement = false;                      // where it is linearised
  Pose2 x0;                                         // T_world_robot
  Eigen::Vector2d m0 = Eigen::Vector2d::Zero();     // p_world_landmark [m]
};

/// Linearised at the mean of the state. With first estimates, the column of J_x for the heading is taken from
/// these.
ObservationFactor linearise(const InformationState& state, int slot, const Observation& observation,
                            const Pose2& T_robot_sensor);
/// The same for a passive landmark whose mean the caller knows and the state does not. `mean`: p_world_landmark
/// [m]
ObservationFactor linearise(const InformationState& state, int slot, const Eigen::Vector2d& mean,
                            const Observation& observation, const Pose2& T_robot_sensor);

/// Linearised at the position where the sensor says that the landmark is, seen from the mean of the pose. For
/// poses with such a large error that the believed direction to the landmark is useless, as at the end of a
/// long loop.
ObservationFactor linearise_at_measurement(const InformationState& state, int slot,
                                           const Observation& observation, const Pose2& T_robot_sensor);

/// Q: the covariance of the observation, and `noise` on its diagonal. (2 x 2)
Eigen::Matrix2d covariance(const ObservationFactor& factor);
/// Sets `noise` and Q_inverse.
void set_noise(ObservationFactor& factor, const Eigen::Vector2d& noise);

/// The innovation that the factor gives at the present mean: v - J (mu - mu_0). [m, rad]
Eigen::Vector2d residual(const InformationState& state, const ObservationFactor& factor);

/// v' Q^-1 v. [-]
double squared_norm(const Eigen::Vector2d& v, const ObservationFactor& factor);

/// Eqs. (21), (22): Omega += J' Q^-1 J, and r += J' Q^-1 v with v at the present mean. Takes the landmark into
/// the window.
void add(InformationState& state, const ObservationFactor& factor);

/// Takes out what add() has added, even if the mean has moved since. The landmark must still be active.
void subtract(InformationState& state, const ObservationFactor& factor);

}  // namespace seif
