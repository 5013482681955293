// How far an observation may be from its linear equation, as a noise that is added to the sensor's.
//
// A filter that takes a curve for a line is overconfident as soon as the bend is larger than the noise of the
// sensor: where ranges are good and bearings bad, or where the pose or a landmark is hardly known yet. So the
// second-order terms of an observation count as noise. They shrink with the belief's own covariance. This is the
// idea of the second-order filter and of posterior linearisation (Garcia-Fernandez, Svensson, Morelande, Sarkka:
// "Posterior linearization filter", IEEE Transactions on Signal Processing, 2015), in constant time.
#pragma once

#include <Eigen/Core>

#include "seif/information_state.hpp"
#include "seif/observation_factor.hpp"
#include "seif/window_factor.hpp"

namespace seif {

/// The variance of the heading, by (L L')^-1, the belief of `window`; at least half a degree squared. [rad^2]
/// `scratch` (w x 3).
double heading_variance(const WindowFactor& window, Eigen::Matrix<double, Eigen::Dynamic, 3>& scratch);

/// Mean squares of the second-order terms of range and bearing: (2 x 1) [m^2, rad^2].
/// With C the covariance of where the robot sees the landmark, along and across its direction, V the variance
/// of the heading, and o the error of J_x's heading column (first estimates):
///   range    3/4 C_aa^2 / d^2 + V (C_aa + o_1^2)
///   bearing  (C_ll C_aa + 2 C_la^2) / d^4 + V (C_ll / d^2 + o_2^2)
/// for a distance d. The belief is that of `window`, which must be up to date; `scratch` as above.
Eigen::Vector2d linearisation_noise(const InformationState& state, const ObservationFactor& factor,
                                    const WindowFactor& window,
                                    Eigen::Matrix<double, Eigen::Dynamic, 3>& scratch);

/// The same for a landmark of which nothing but the observation is known, with V [rad^2].
Eigen::Vector2d linearisation_noise(const Observation& observation, double V);

/// A guess of the first function in a few operations. Instead of C it takes the larger of the sensor's noise and
/// the innovation, and beside V what an innovation has beyond three sigma: then the guess, and with it the work,
/// does not grow with the uncertainty of the heading along a drive. No bound: an error can be larger than what a
/// single innovation shows.
Eigen::Vector2d rough_linearisation_noise(const ObservationFactor& factor, double V);

}  // namespace seif
