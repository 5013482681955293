#include "sim/near_solids.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace sim {

namespace {

// Streaming costs a query and a few insertions. Once for each metre it is nothing beside the 240 steps and
// more that the robot takes for it, and the square stays small enough for a step to cost little in a dense
// forest.
constexpr double travel_between_streams = 1.0;  // [m]

// What the robot may do within one step (50 m/s at 240 Hz), and Bullet's contact margins.
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

void NearSolids::follow(const Eigen::Vector2d& p_world_robot) {
  if (!p_world_streamed_ || (p_world_robot - *p_world_streamed_).norm() >= travel_between_streams) {
    stream(p_world_robot);
    p_world_streamed_ = p_world_robot;
  }
}

/// Takes out what is far and puts in what is new. What stays is not touched, so that a contact that lasts
/// keeps what the solver knows of it.
void NearSolids::stream(const Eigen::Vector2d& p_world_robot) {
  const Eigen::Vector2d reach(reach_, reach_);
  sensing_.solids_in_box(p_world_robot - reach, p_world_robot + reach, wanted_);
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

/// A new object, in a node of the map that was taken out before if there is one: in the long run nothing is
/// allocated.
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
  // Bullet takes an object that it is handed for awake, and would compute its bounding box at every step.
  object.setActivationState(ISLAND_SLEEPING);
  stepped_.bullet().addCollisionObject(&object, CollisionGroup::solid, CollisionGroup::solid_meets);
}

}  // namespace sim
