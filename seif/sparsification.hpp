// Sparsification: takes away the robot's links to some of the active landmarks; section 3.3 of the report.
#pragma once

#include <span>
#include <vector>

#include "seif/information_state.hpp"

namespace seif {

/// The report's rule, eq. (50): in p(x | Y+, Y0, Y- = 0) the robot's dependence on the landmarks Y0 is
/// dropped, and p(Y) is kept. Setting the passive landmarks Y- to a constant anchors the window to the world
/// frame, which counts as known what is not: the filter becomes overconfident.
///
/// The active landmarks `slots` become passive. r stays, and so does the mean, eq. (51).
/// False, with the state unchanged, if Omega turns out not to be positive definite.
[[nodiscard]] bool sparsify_report(InformationState& state, std::span<const int> slots);

/// Which active landmarks lose their link to the robot first. A link's strength is the Frobenius norm of its
/// block.
enum class DropOrder {
  weakest_link,         // the report's, to the letter
  weakest_out_of_view,  // the weakest link of those that the latest scan did not see; then the weakest of the
                        // others
  least_recently_seen   // of those seen last in the same scan, the weakest link
};

/// Fills `slots` with the `count` active landmarks that come first in that order. `count` is at most
/// active_count().
void choose_to_drop(const InformationState& state, DropOrder order, int count, std::vector<int>& slots);

}  // namespace seif
