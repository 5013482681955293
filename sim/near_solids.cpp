#include "sim/near_solids.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

namespace sim {

namespace {

// Streaming costs one query for each robot, and a few insertions. Once per metre this is negligible beside the 240 or more
// steps that the robot needs for a metre, and the square stays small enough for a step to be cheap in a dense
// forest.
constexpr double travel_between_streams = 1.0;  // [m]

// The distance that the robot may move within one step (50 m/s at 240 Hz), and Bullet's contact margins.
constexpr double reserve = 0.2;  // [m]

}  // namespace

NearSolids::NearSolids(const Solids& solids, const SensingWorld& sensing, SteppedWorld& stepped,
                       double footprint_radius)
    : solids_(solids),
      sensing_(sensing),
      stepped_(stepped),
      reach_(footprint_radius + travel_between_streams + reserve) {}

NearSolids::~NearSolids() {
  for (auto& [solid, object] : present_) {
    stepped_.bullet().removeCollisionObject(&object);
  }
}

void NearSolids::follow(std::span<const Eigen::Vector2d> p_world_robots) {
  if (is_streamed(p_world_robots)) return;
  stream(p_world_robots);
  p_world_streamed_.assign(p_world_robots.begin(), p_world_robots.end());
}

bool NearSolids::is_streamed(std::span<const Eigen::Vector2d> p_world_robots) const {
  if (p_world_streamed_.size() != p_world_robots.size()) return false;
  for (std::size_t i = 0; i < p_world_robots.size(); ++i) {
    if ((p_world_robots[i] - p_world_streamed_[i]).norm() >= travel_between_streams) return false;
  }
  return true;
}

/// Takes out solids that are far and inserts new ones. A solid that stays is not touched, so that the solver
/// keeps its data about lasting contacts.
void NearSolids::stream(std::span<const Eigen::Vector2d> p_world_robots) {
  const Eigen::Vector2d reach(reach_, reach_);
  wanted_.clear();
  for (const Eigen::Vector2d& p : p_world_robots) {
    sensing_.solids_in_box(p - reach, p + reach, of_one_);
    wanted_.insert(wanted_.end(), of_one_.begin(), of_one_.end());
  }
  std::ranges::sort(wanted_);
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
  for (auto entry = present_.begin(); entry != present_.end();) {
    if (std::binary_search(wanted_.begin(), wanted_.end(), entry->first)) {
      ++entry;
    } else {
      stepped_.bullet().removeCollisionObject(&entry->second);
      spare_.push_back(present_.extract(entry++));
    }
  }
  for (const int solid : wanted_) {
    if (!present_.contains(solid)) {
      insert(solid);
    }
  }
}

/// A new object. It uses a map node that was taken out before, if there is one, so that nothing is allocated in
/// the long run.
btCollisionObject& NearSolids::new_object(int solid) {
  if (spare_.empty()) {
    return present_[solid];
  }
  Present::node_type node = std::move(spare_.back());
  spare_.pop_back();
  node.key() = solid;
  std::destroy_at(&node.mapped());
  std::construct_at(&node.mapped());
  return present_.insert(std::move(node)).position->second;
}

void NearSolids::insert(int solid) {
  btCollisionObject& object = new_object(solid);
  object.setCollisionShape(&solids_.shape(solid));
  object.setWorldTransform(solids_.T_world_solid(solid));
  // Bullet takes a new object as awake, and would compute its bounding box at every step.
  object.setActivationState(ISLAND_SLEEPING);
  stepped_.bullet().addCollisionObject(&object, CollisionGroup::solid, CollisionGroup::solid_meets);
}

}  // namespace sim
