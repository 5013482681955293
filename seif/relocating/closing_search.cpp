#include "seif/relocating/closing_search.hpp"

#include <algorithm>
#include <utility>

#include "seif/association/association.hpp"
#include "seif/estimator.hpp"
#include "seif/relocating/constellation_match.hpp"
#include "seif/relocating/contradiction.hpp"
#include "seif/relocating/placement.hpp"

namespace seif {
namespace {

constexpr std::size_t most_young = 24;   // [-] landmarks around the robot that are used
constexpr std::size_t fewest_twins = 4;  // [-]
/// For a landmark that has settled.
constexpr ConstellationSearch::Limits limits{.triangles = 400, .poses = 40};
/// [-] So far from where it believes itself a robot may be, over what it sees.
constexpr double reaches = 4.0;

}  // namespace

std::optional<Closing> ClosingSearch::look(const Pose2& T_world_robot, LandmarkId oldest_seen, double t) {
  if (!find_around(T_world_robot, oldest_seen)) return std::nullopt;
  look_from_settled(T_world_robot);
  const std::optional<ConstellationSearch::Found> found = search_->best();
  if (!found || search_->is_ambiguous()) return std::nullopt;
  const bool is_old =
      std::ranges::all_of(found->pairs, [&](const Pairing& pair) { return pair.landmark < oldest_seen; });
  if (!is_old || found->pairs.size() < fewest_twins) return std::nullopt;
  std::optional<Closing> closing = verify(T_world_robot, *found, t);
  if (closing) work_ += std::exchange(search_, std::nullopt)->work();
  return closing;
}

/// The nearest first.
bool ClosingSearch::find_around(const Pose2& T_world_robot, LandmarkId oldest_seen) {
  map_.grid().find_near({T_world_robot.x, T_world_robot.y}, map_.reach(), most_young, near_);
  around_.p_local.clear();
  around_.own.clear();
  for (const LandmarkGrid::Near& near : near_) {
    if (near.landmark < oldest_seen || !belief_.is_at_hand(near.landmark)) continue;
    around_.p_local.push_back(map_.grid().position(near.landmark));
    around_.own.push_back(near.landmark);
  }
  around_.farthest = reaches * map_.reach();
  return around_.own.size() >= fewest_twins;
}

/// The frame of the search is that of the map.
void ClosingSearch::look_from_settled(const Pose2& T_world_robot) {
  if (!search_) search_.emplace(map_.grid(), map_.index(), map_.near());
  search_->set_points(around_, T_world_robot, T_world_robot);
  for (const LandmarkId landmark : map_.just_settled()) {
    const auto corner = std::ranges::find(around_.own, landmark);
    if (corner != around_.own.end())
      search_->look_from(static_cast<std::size_t>(corner - around_.own.begin()), limits);
  }
}

std::optional<Closing> ClosingSearch::verify(const Pose2& T_world_robot,
                                             const ConstellationSearch::Found& found, double t) {
  std::vector<LandmarkId> all = around_.own;
  for (const Pairing& pair : found.pairs) all.push_back(pair.landmark);
  if (!belief_.bring(all)) throw NumericalFailure("relocation", t);
  const Surroundings surroundings = surroundings_of(belief_, T_world_robot, around_.own);
  Placement placement;
  if (!place(belief_, surroundings, found, T_world_robot, placement) ||
      log_chance(surroundings.size(), found, placement) > most_log_chance_)
    return std::nullopt;
  Closing closing{.twins = {}, .around = around_.own, .relocation = {}};
  for (const Pairing& pair : placement.pairs)
    closing.twins.push_back({around_.own[pair.around], pair.landmark});
  if (contradicts(closing.twins)) {
    std::vector<LandmarkId> names(surroundings.size(), no_landmark);
    std::vector<bool> is_used(surroundings.size(), false);
    for (const Pairing& pair : placement.pairs) {
      names[pair.around] = pair.landmark;
      is_used[pair.around] = true;
    }
    closing.relocation = relocation_to(belief_, T_world_robot, surroundings, placement, names, is_used);
    closing.relocation->keeps_pose = false;
  }
  return closing;
}

/// By the majority of the twins: where they lie apart, by the covariance of their distance.
bool ClosingSearch::contradicts(const std::vector<Closing::Twins>& twins) const {
  std::vector<LandmarkId> ids;
  for (const auto& [young, old] : twins) ids.insert(ids.end(), {young, old});
  const auto rows = static_cast<Eigen::Index>(3 + 2 * ids.size());
  Eigen::MatrixXd Sigma(rows, rows);
  belief_.covariance_with(ids, Sigma);
  std::size_t against = 0;
  for (std::size_t i = 0; i < twins.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 + 4 * i);
    const Eigen::Vector2d apart = belief_.mean_of(twins[i].young) - belief_.mean_of(twins[i].old);
    if (!(squared_distance_apart(Sigma, row, row + 2, apart) <= contradiction)) ++against;
  }
  return 2 * against > twins.size();
}

}  // namespace seif
