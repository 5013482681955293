#include "seif/relocating/constellation_match.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace seif {
namespace {

constexpr double kept_share = 0.75;     // [-] of the pairs that must agree by the filter's covariance
constexpr std::size_t fewest_kept = 3;  // [-] and at least so many

}  // namespace

bool place(const LocalBelief& belief, const Surroundings& surroundings,
           const ConstellationSearch::Found& found, const Pose2& T_local_robot, Placement& placement) {
  placement.pairs = found.pairs;
  placement.T_world_robot = found.T_world_local * T_local_robot;
  const auto share =
      static_cast<std::size_t>(std::ceil(kept_share * static_cast<double>(found.pairs.size())));
  return fit_most(belief, surroundings, std::max(fewest_kept, share), placement);
}

double log_chance(std::size_t points, const ConstellationSearch::Found& found, const Placement& placement) {
  const auto k = static_cast<double>(points);
  const auto m = static_cast<double>(placement.pairs.size());
  const double dimensions = 2.0 * m - 3.0;
  const double q = std::max(placement.squared_distance, dimensions);
  const double log_ball =
      0.5 * dimensions * std::log(std::numbers::pi * q) - std::lgamma(0.5 * dimensions + 1.0);
  const double log_choices = std::lgamma(k + 1.0) - std::lgamma(m + 1.0) - std::lgamma(k - m + 1.0);
  return log_choices + m * std::log(found.density) + found.log_places + placement.log_density_of_poses +
         log_ball;
}

Relocation named_relocation(const LocalBelief& belief, const SettledConstellations& map,
                            const Surroundings& surroundings, const Placement& placement,
                            const Pose2& T_world_robot) {
  std::vector<LandmarkId> names(surroundings.size(), no_landmark);
  std::vector<bool> is_used(surroundings.size(), true);
  std::vector<LandmarkGrid::Near> beside;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto pair = std::ranges::find(placement.pairs, i, &Pairing::around);
    if (pair != placement.pairs.end()) {
      names[i] = pair->landmark;
      continue;
    }
    map.grid().find_near(placement.T_world_robot * surroundings.at(i), 2.0 * map.near(), 1, beside);
    is_used[i] = beside.empty();
  }
  return relocation_to(belief, T_world_robot, surroundings, placement, names, is_used);
}

}  // namespace seif
