// The run that the figures show: the first one.
#pragma once

#include <string>
#include <vector>

#include "harness/paper/belief.hpp"
#include "harness/paper/paper.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Runs the first seed again, with those of the EKF, the report's filter in constant time and ours that the
/// world has. Their beliefs at the end, in this order. Throws std::runtime_error if one cannot be drawn.
std::vector<Belief> drawn_beliefs(const PaperPlan& plan, const seif::Registry& registry);

/// Draws figure1, figure2 and figure6 of it in the plan's folder. What went wrong, or nothing.
std::string draw_figures(const PaperPlan& plan, const seif::Registry& registry);

}  // namespace harness
