#include "seif/measurement_update.hpp"

#include <optional>

#include "seif/models.hpp"
#include "seif/observation_factor.hpp"

namespace seif {

int measurement_update(InformationState& state, std::span<const Observation> observations,
                       const Pose2& T_robot_sensor) {
  const int known = state.landmark_count();
  state.begin_scan();
  for (const Observation& observation : observations) {
    std::optional<int> slot = state.find(observation.landmark);
    if (!slot) {
      slot =
          state.add_landmark(observation.landmark,
                             invert_observation(state.pose(), T_robot_sensor, observation).p_world_landmark);
    }
    state.mark_seen(*slot);
    add(state, linearise(state, *slot, observation, T_robot_sensor));
  }
  return state.landmark_count() - known;
}

}  // namespace seif
