// Steps of Seif's measurement update that need the state alone.
#pragma once

#include <utility>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/observation_factor.hpp"

namespace seif {

/// The standard deviation of a sighting: the larger of the range's and the bearing's. [m]
double sd_of_sighting(const Observation& observation);

/// Whether the landmark is seen so far from its mean that the direction to the mean is useless: farther than
/// `closing_gate` times the measured range. Never if `closing_gate` is 0.
bool is_closing(const InformationState& state, int slot, const Observation& observation,
                const Pose2& T_robot_sensor, double closing_gate);

/// Replaces `factors` by those of the observations of active landmarks, all linearised at one state: eqs.
/// (15), (23). One that is_closing() is linearised at the measurement.
void linearise_known(const InformationState& state, const Scan& scan, const Pose2& T_robot_sensor,
                     double closing_gate, std::vector<ObservationFactor>& factors);

/// Takes those factors out whose nonlinearity at the present mean is above `relinearise_above`, and puts them
/// in again, linearised there. True if there was one. [sigma]
bool relinearise(InformationState& state, const Pose2& T_robot_sensor, double relinearise_above,
                 std::vector<ObservationFactor>& factors);

/// Takes in that these pairs of active landmarks are one: m_a - m_b = 0 with standard deviation equal_sd.
/// Where their first estimates lie apart, the lever between these goes into the Jacobian, so that the filter
/// learns no heading from it.
void add_equal(InformationState& state, const std::vector<std::pair<int, int>>& equal_slots);

}  // namespace seif
