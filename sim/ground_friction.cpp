#include "sim/ground_friction.hpp"

#include <algorithm>

namespace sim {

double ground_friction(const worlds::Physics& physics, const Eigen::Vector2d& p_world) {
  const auto holds = [&](const worlds::FrictionPatch& patch) {
    return (p_world.array() >= patch.min.array()).all() && (p_world.array() <= patch.max.array()).all();
  };
  const auto last = std::find_if(physics.patches.rbegin(), physics.patches.rend(), holds);
  return last == physics.patches.rend() ? physics.friction : last->friction;
}

}  // namespace sim
