// Sparsification removes the robot's links to some of the active landmarks; section 3.3 of the report.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "seif/information_state.hpp"

namespace seif {

/// All rules keep p(Y), the belief over the map. They replace p(x | Y) by a p(x | Y+) in which the robot no
/// longer depends on the dropped landmarks Y0, eq. (46). The rules differ in the belief D from which they take
/// p(x | Y+).
enum class SparsificationRule {
  /// Eqs. (47) to (50): D = p(x, Y+, Y0 | Y- = 0). Setting the passive landmarks Y- to a constant anchors the
  /// window to the world frame. This adds information that no measurement has given: the filter becomes
  /// overconfident. In constant time.
  report,
  /// D = p(x, Y+, Y0), with the passive landmarks marginalised out: Eustice, Walter, Leonard, "Sparse extended
  /// information filters: insights into sparsification", IROS 2005. Not in constant time.
  modified,
  /// D = p(x, Y+, Y0 | Y- = 0) without its rigid-body modes, that is, without its information about the
  /// position and heading of the window as a whole. So nothing is anchored, and the information between the
  /// landmarks of the window and the robot is kept. In constant time. That this is not overconfident is
  /// measured, not proven.
  gauge_free
};

/// Removes the robot's links to the active landmarks `slots`, which become passive; where frozen information is
/// kept apart, freeze() makes them passive afterwards. r stays, and so does the mean, eq. (51). At least one landmark must stay active; with gauge_free two, at different places.
///
/// Returns how much more information about the pose, given the landmarks that stay, the report's rule would
/// keep than D does: log det Lambda(H0) - log det Lambda(D) [nat], with Lambda the information of p(x | Y+) and
/// H0 the report's name for its D. This is the anchoring to the world frame that was left out. Nothing, with
/// the state unchanged, if a matrix is not positive definite.
[[nodiscard]] std::optional<double> sparsify(InformationState& state, SparsificationRule rule,
                                             std::span<const int> slots);

/// Which active landmarks lose their link to the robot first. The strength of a link is the Frobenius norm of its
/// block.
enum class DropOrder {
  weakest_link,         // the report's order, to the letter
  weakest_out_of_view,  // the weakest links among landmarks out of view; then the weakest of the others
  least_recently_seen   // among landmarks seen last in the same scan, the weakest link
};

/// Fills `slots` with the `count` active landmarks that come first in that order. `count` is at most
/// active_count().
void choose_to_drop(const InformationState& state, DropOrder order, int count, std::vector<int>& slots);

/// When the robot has too many links, and which it keeps.
struct LinkBounds {
  int theta_x = 6;    // [-] links that stay after a sparsification
  int theta_max = 0;  // [-] sparsify above this, or above theta_x if that is larger
  DropOrder order = DropOrder::least_recently_seen;  // which lose their link first
  bool keep_in_view = true;                          // never drop a landmark of the latest scan
};

/// Fills `slots` with the active landmarks that are to lose their link to the robot now; often there are none.
void choose_surplus(const InformationState& state, const LinkBounds& bounds, std::vector<int>& slots);

}  // namespace seif
