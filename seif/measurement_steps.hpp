// Steps of Seif's measurement update that need nothing but the state.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/observation_factor.hpp"

namespace seif {

/// The standard deviation of a sighting: the larger of the range's and the bearing's, as a distance. [m]
double sd_of_sighting(const Observation& observation);

/// Whether the landmark is seen so far from its mean that the direction to the mean is useless: farther than
/// `closing_gate` times the measured range, and farther than the noise of the sighting explains. This happens
/// when a long loop closes. Always false if `closing_gate` is 0.
bool is_closing(const InformationState& state, int slot, const Observation& observation,
                const Pose2& T_robot_sensor, double closing_gate);

/// Replaces `factors` by the factors of all observations of active landmarks, all linearised at the present
/// state: eqs. (15), (23). An observation for which is_closing() holds is linearised at the measurement.
void linearise_known(const InformationState& state, const Scan& scan, const Pose2& T_robot_sensor,
                     double closing_gate, std::vector<ObservationFactor>& factors);

/// Whether `now`, the same observation linearised at the present mean, should replace `factor`: the nonlinearity
/// is above `relinearise_above` [sigma], or the noise of the linearisation has become much smaller.
bool is_stale(const InformationState& state, const ObservationFactor& factor, const ObservationFactor& now,
              double relinearise_above);

/// Takes out all factors of a scan.
void subtract_all(InformationState& state, std::span<const ObservationFactor> factors);
/// Adds them again: linearised at the present mean, and with the noise that they have.
void add_again(InformationState& state, const Pose2& T_robot_sensor, std::span<ObservationFactor> factors);

/// Adds the information that the two landmarks of each pair are the same one: m_a - m_b = 0 with standard
/// deviation equal_sd. Skips pairs that are not both active. If their first estimates lie apart, the lever
/// between these enters the Jacobian, so that the filter learns no heading from it.
void add_equal(InformationState& state, const std::vector<std::pair<int, int>>& equal_slots);

}  // namespace seif
