// The run whose beliefs the figures show: that of the first seed.
#pragma once

#include <string>
#include <vector>

#include "harness/paper/belief.hpp"
#include "harness/paper/paper.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Runs the first seed again with those of three filters that the world has: the EKF, the report's filter in
/// constant time, and ours. Returns their final beliefs in this order. Throws std::runtime_error if a belief
/// cannot be drawn.
std::vector<Belief> drawn_beliefs(const PaperPlan& plan, const seif::Registry& registry);

/// Draws figure1, figure2 and figure6 into the plan's folder. Returns an error message, or nothing.
std::string draw_figures(const PaperPlan& plan, const seif::Registry& registry);

}  // namespace harness
