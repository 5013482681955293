// Finds the loop closures of a run and tells how the error changes after them. Definitions: docs/scores.md.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "seif/types.hpp"

namespace harness {

/// The landmarks that a scan saw.
struct SeenScan {
  double t = 0.0;  // [s]
  std::vector<seif::LandmarkId> landmarks;
};

/// The indices of the scans that close a loop: the scan sees a landmark that was seen before, and then not
/// for `away` [s] or longer. At least `away` [s] lie between two closures.
std::vector<std::size_t> loop_closures(std::span<const SeenScan> scans, double away);

/// [-] number of updates after the closure at which the error is taken; -1 is the last update before it
inline constexpr std::array<int, 8> response_updates = {-1, 0, 1, 2, 5, 10, 20, 50};

/// The root mean square error, over all closures, at each of response_updates. An entry is empty if no
/// closure has an error there. `errors` has one value for each scan; the last ones may be missing. Unit: that
/// of `errors`.
std::array<std::optional<double>, response_updates.size()> closure_response(
    std::span<const std::size_t> closures, std::span<const double> errors);

}  // namespace harness
