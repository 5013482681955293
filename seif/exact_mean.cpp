#include "seif/exact_mean.hpp"

#include <vector>

#include "seif/mean_recovery.hpp"

namespace seif {

bool ExactMean::activate(InformationState& state, std::vector<int>& slots, double /*range*/) {
  for (const int slot : slots) {
    if (state.position(slot) < 0) state.activate(slot);
  }
  return true;
}

bool ExactMean::solve_window(InformationState& state) {
  const Eigen::Index w = state.window_size();
  if (step_.size() < w) step_.resize(2 * w);
  auto step = step_.head(w);
  step = state.r();
  if (!solve_for_window(state, step)) return false;
  state.move_window(step);
  return true;
}

bool ExactMean::end_update(InformationState& state) { return solve_mean(state); }

std::size_t ExactMean::memory_bytes() const {
  return static_cast<std::size_t>(step_.size()) * sizeof(double);
}

}  // namespace seif
