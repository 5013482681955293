// The measurement update of the information form: eqs. (21), (22), Lemma 1 of the report.
#pragma once

#include <span>

#include "seif/information_state.hpp"
#include "seif/types.hpp"

namespace seif {

/// Adds the information of the observations, all linearised at the present mean. A landmark that is not in the
/// map joins it at the position that the inverse observation gives. A passive landmark becomes active. The
/// means of robot and known landmarks do not move: that is left to the mean recovery. Returns the number of
/// landmarks that joined.
int measurement_update(InformationState& state, std::span<const Observation> observations,
                       const Pose2& T_robot_sensor);

}  // namespace seif
