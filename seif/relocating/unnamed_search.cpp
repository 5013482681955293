#include "seif/relocating/unnamed_search.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/relocating/constellation_match.hpp"

namespace seif {
namespace {

constexpr std::size_t most_points = 24;        // [-] landmarks of the local map that are looked for
constexpr std::ptrdiff_t fewest_compared = 2;  // [-] observations of a scan that says something
constexpr int scans_to_break = 3;              // [-]

}  // namespace

UnnamedSearch::UnnamedSearch(LocalBelief& belief, const SettledConstellations& map,
                             LocalMap::MakeFilter make_local, const Pose2& T_robot_sensor,
                             double most_log_chance)
    : belief_(belief),
      map_(map),
      local_(std::move(make_local), T_robot_sensor),
      most_log_chance_(most_log_chance) {}

void UnnamedSearch::begin() {
  end();
  local_.begin();
  search_.emplace(map_.grid(), map_.index(), map_.near());
  has_fitted_ = false;
  broken_ = 0;
}

/// Whether the robot has lost its place in the local map, too: scans in a row in which most of what is seen is unknown.
bool UnnamedSearch::breaks_off(const Scan& scan) {
  const auto observed = std::ssize(scan.observations);
  if (observed < fewest_compared) return false;
  const auto unknown = std::ranges::count(local_.filter().associations(), no_landmark);
  const bool fits = 2 * unknown <= observed;
  has_fitted_ = has_fitted_ || fits;
  broken_ = has_fitted_ && !fits ? broken_ + 1 : 0;
  return broken_ >= scans_to_break;
}

void UnnamedSearch::end() {
  if (search_) work_ += search_->work();
  local_.end();
  search_.reset();
}

std::optional<Relocation> UnnamedSearch::measurement_update(const Scan& scan, const Pose2& T_world_robot) {
  local_.measurement_update(scan);
  if (breaks_off(scan)) begin();
  const Surroundings surroundings =
      local_.read(scan.t, most_points);  // the first of those that are carried over
  const Pose2 T_local_robot = local_.filter().pose();
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < surroundings.size(); ++i) points.push_back(T_local_robot * surroundings.at(i));
  search_->set_points({.p_local = points}, T_local_robot, T_world_robot);
  search_->consider(T_world_robot * inverse(T_local_robot));
  search_->look_around();
  const std::optional<ConstellationSearch::Found> found = search_->best();
  if (!found) return std::nullopt;
  std::vector<LandmarkId> ids;
  for (const Pairing& pair : found->pairs) ids.push_back(pair.landmark);
  if (!belief_.bring(ids)) throw NumericalFailure("relocation", scan.t);
  Placement placement;
  if (!place(belief_, surroundings, *found, T_local_robot, placement) ||
      log_chance(surroundings.size(), *found, placement) > most_log_chance_)
    return std::nullopt;
  return named_relocation(belief_, map_, local_.read(scan.t, LocalMap::most_carried), placement,
                          T_world_robot);
}

}  // namespace seif
