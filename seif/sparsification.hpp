// Sparsification: takes away the robot's links to some of the active landmarks; section 3.3 of the report.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "seif/information_state.hpp"

namespace seif {

/// All rules keep p(Y), the belief over the map, and replace p(x | Y) by a p(x | Y+) in which the robot no
/// longer depends on the landmarks Y0 that are dropped, eq. (46). They differ in the belief D from which p(x
/// | Y+) is taken.
enum class SparsificationRule {
  /// Eqs. (47)-(50): D = p(x, Y+, Y0 | Y- = 0). To set the passive landmarks Y- to a constant anchors the
  /// window to the
  /// world frame, which counts as known what is not: the filter becomes overconfident. In constant time.
  report,
  /// D = p(x, Y+, Y0), the passive landmarks marginalised out: Eustice, Walter, Leonard, "Sparse extended
  /// information
  /// filters: insights into sparsification", IROS 2005. Not in constant time.
  modified,
  /// D = p(x, Y+, Y0 | Y- = 0) with its rigid-body modes taken out: what it knows of where the window lies as
  /// a whole. So
  /// nothing is anchored, and what the landmarks of the window tell of each other and of the robot is kept.
  /// In constant
  /// time. That it does not make the filter overconfident is measured, not proven.
  gauge_free
};

/// Takes away the robot's links to the active landmarks `slots`, which become passive. r stays, and so does
/// the mean, eq. (51). At least one landmark must stay active; with gauge_free two, at different places.
///
/// Returns how much less D knows of the pose, given the landmarks that stay, than the report's rule takes it
/// to know: log det Lambda(H0) - log det Lambda(D), with Lambda the information of p(x | Y+). [nat] That is
/// the anchoring to the world frame that was left out. Nothing, with the state unchanged, if a matrix turns
/// out not to be positive definite.
[[nodiscard]] std::optional<double> sparsify(InformationState& state, SparsificationRule rule,
                                             std::span<const int> slots);

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
