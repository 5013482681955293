#include "seif/relocating/unnamed_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "seif/estimator.hpp"

namespace seif {
namespace {

constexpr int settled_after = 15;        // [-] scans until a landmark's place counts
constexpr std::size_t most_settled = 2;  // [-] landmarks that one scan adds to the index
constexpr double widths = 4.0;           // [-] of the index, over the standard deviation of a sighting
constexpr double nears = 5.0;            // [-] the same, of how near something must be to a landmark
constexpr std::size_t most_points = 24;  // [-] landmarks of the local map that are used
constexpr double kept_share = 0.75;      // [-] of the pairs that must agree by the filter's covariance
constexpr std::size_t fewest_kept = 3;   // [-] and at least so many

}  // namespace

UnnamedSearch::UnnamedSearch(LocalBelief& belief, LocalMap::MakeFilter make_local,
                             const Pose2& T_robot_sensor, double most_chance)
    : belief_(belief),
      local_(std::move(make_local), T_robot_sensor),
      most_log_chance_(std::log(most_chance)) {}

void UnnamedSearch::use(const LandmarkGrid& grid, double sighting_sd, double reach) {
  grid_ = &grid;
  index_.emplace(widths * sighting_sd);
  near_ = nears * sighting_sd;
  reach_ = reach;
}

void UnnamedSearch::keep_up(int scan) {
  for (std::size_t i = 0; i < most_settled && next_young_ < young_.size(); ++i) {
    if (scan - young_[next_young_].joined < settled_after) break;
    const LandmarkId landmark = young_[next_young_++].landmark;
    if (grid_->has(landmark)) index_->add(*grid_, landmark, reach_);
    work_ += ConstellationIndex::neighbours;
  }
  if (next_young_ == young_.size()) {
    young_.clear();
    next_young_ = 0;
  }
}

/// What has just joined is what the robot sees, so it counts at once.
void UnnamedSearch::begin() {
  for (; next_young_ < young_.size(); ++next_young_) {
    if (grid_->has(young_[next_young_].landmark)) index_->add(*grid_, young_[next_young_].landmark, reach_);
  }
  local_.begin();
  search_.emplace(*grid_, *index_, near_);
}

void UnnamedSearch::end() {
  if (search_) work_ += search_->work();
  local_.end();
  search_.reset();
}

std::optional<Relocation> UnnamedSearch::measurement_update(const Scan& scan, const Pose2& T_world_robot) {
  local_.measurement_update(scan);
  local_.read(scan.t, most_points, surroundings_);
  const Pose2 T_local_robot = local_.filter().pose();
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < surroundings_.size(); ++i)
    points.push_back(T_local_robot * surroundings_.at(i));
  search_->step(points, T_local_robot, T_world_robot);
  const std::optional<ConstellationSearch::Found> found = search_->best();
  Placement placement;
  if (!found || !place(*found, placement, scan.t) || log_chance(*found, placement) > most_log_chance_)
    return std::nullopt;
  return named(placement, T_world_robot);
}

/// By the filter's covariance of the landmarks that it is taken for.
bool UnnamedSearch::place(const ConstellationSearch::Found& found, Placement& placement, double t) {
  placement.pairs = found.pairs;
  placement.T_world_robot = found.T_world_local * local_.filter().pose();
  std::vector<LandmarkId> ids;
  for (const Pairing& pair : found.pairs) ids.push_back(pair.landmark);
  if (!belief_.bring(ids)) throw NumericalFailure("relocation", t);
  const auto share =
      static_cast<std::size_t>(std::ceil(kept_share * static_cast<double>(found.pairs.size())));
  return fit_most(belief_, surroundings_, std::max(fewest_kept, share), placement);
}

/// [nat] How many matches as good as this are to be expected by chance: an upper bound of the probability that there is
/// one. Of k points, m lie at landmarks of the map, scattered with a density. The coordinates of m landmarks that some pose
/// fits with v' S^-1 v <= q fill, of their space of 2m dimensions, a tube around all poses; it is as thick as a ball of
/// 2m - 3 dimensions.
double UnnamedSearch::log_chance(const ConstellationSearch::Found& found, const Placement& placement) const {
  const auto k = static_cast<double>(surroundings_.size());
  const auto m = static_cast<double>(placement.pairs.size());
  const double dimensions = 2.0 * m - 3.0;
  const double q = std::max(placement.squared_distance, dimensions);
  const double log_ball =
      0.5 * dimensions * std::log(std::numbers::pi * q) - std::lgamma(0.5 * dimensions + 1.0);
  const double log_choices = std::lgamma(k + 1.0) - std::lgamma(m + 1.0) - std::lgamma(k - m + 1.0);
  return log_choices + m * std::log(found.density) + found.log_places + placement.log_density_of_poses +
         log_ball;
}

Relocation UnnamedSearch::named(const Placement& placement, const Pose2& T_world_robot) const {
  std::vector<LandmarkId> names(surroundings_.size(), no_landmark);
  std::vector<bool> is_used(surroundings_.size(), true);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto pair = std::ranges::find(placement.pairs, i, &Pairing::around);
    if (pair != placement.pairs.end()) {
      names[i] = pair->landmark;
      continue;
    }
    // What lies beside a landmark of the map, and is not clearly that one, is left out.
    std::vector<LandmarkGrid::Near> beside;
    grid_->find_near(placement.T_world_robot * surroundings_.at(i), 2.0 * near_, 1, beside);
    is_used[i] = beside.empty();
  }
  return relocation_to(belief_, T_world_robot, surroundings_, placement, names, is_used);
}

std::size_t UnnamedSearch::memory_bytes() const {
  return (index_ ? index_->memory_bytes() : 0) + (local_.is_begun() ? local_.filter().memory_bytes() : 0) +
         young_.capacity() * sizeof(Young);
}

}  // namespace seif
