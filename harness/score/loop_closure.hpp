// Loop closures in what was seen, and how errors respond to them. Definitions: docs/scores.md.
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

/// The loop closures, as indices of scans: a landmark is seen that was seen before, and then not for `away` [s]
/// or longer. Only the first such scan of each return counts: no closure follows within `away` of another.
std::vector<std::size_t> loop_closures(std::span<const SeenScan> scans, double away);

/// Updates since a closure at which the response is taken; -1 is the last update before it. [-]
inline constexpr std::array<int, 8> response_updates = {-1, 0, 1, 2, 5, 10, 20, 50};

/// Root mean square over the closures of the error at each of response_updates; nothing where no closure has
/// an error there. `errors` has one value for each scan, the last ones may be missing. [as the errors]
std::array<std::optional<double>, response_updates.size()> closure_response(
    std::span<const std::size_t> closures, std::span<const double> errors);

}  // namespace harness
