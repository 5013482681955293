#include "harness/score/loop_closure.hpp"

#include <cmath>
#include <map>

namespace harness {

std::vector<std::size_t> loop_closures(std::span<const SeenScan> scans, double away) {
  std::vector<std::size_t> closures;
  std::map<seif::LandmarkId, double> last_seen;  // [s]
  for (std::size_t i = 0; i < scans.size(); ++i) {
    bool is_return = false;
    for (const seif::LandmarkId landmark : scans[i].landmarks) {
      const auto [seen, is_new] = last_seen.try_emplace(landmark, scans[i].t);
      is_return = is_return || (!is_new && scans[i].t - seen->second >= away);
      seen->second = scans[i].t;
    }
    if (is_return && (closures.empty() || scans[i].t - scans[closures.back()].t >= away))
      closures.push_back(i);
  }
  return closures;
}

std::array<std::optional<double>, response_updates.size()> closure_response(
    std::span<const std::size_t> closures, std::span<const double> errors) {
  std::array<std::optional<double>, response_updates.size()> response;
  for (std::size_t k = 0; k < response.size(); ++k) {
    double sum = 0.0;
    int count = 0;
    for (const std::size_t closure : closures) {
      // A closure is never the first scan.
      const std::size_t update =
          response_updates[k] < 0 ? closure - 1 : closure + static_cast<std::size_t>(response_updates[k]);
      if (update >= errors.size()) continue;
      sum += errors[update] * errors[update];
      ++count;
    }
    if (count > 0) response[k] = std::sqrt(sum / count);
  }
  return response;
}

}  // namespace harness
