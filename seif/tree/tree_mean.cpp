#include "seif/tree/tree_mean.hpp"

namespace seif {

/// The solution for the window is that for all landmarks: the others follow when somebody looks.
bool TreeMean::end_update(InformationState& state) {
  if (!tree_.solve_window(state)) return false;
  return tree_.end_update(state);
}

}  // namespace seif
