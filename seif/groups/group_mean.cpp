#include "seif/groups/group_mean.hpp"

#include <vector>

namespace seif {

bool GroupMean::activate(InformationState& state, std::vector<int>& slots, double /*range*/) {
  for (const int slot : slots) {
    if (state.position(slot) < 0) groups_.activate(state, slot);
  }
  return true;
}

}  // namespace seif
