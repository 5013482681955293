// Keeps the solids near the robot in the stepped world, and no others.
#pragma once

#include <btBulletCollisionCommon.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "sim/sensing_world.hpp"
#include "sim/solids.hpp"
#include "sim/stepped_world.hpp"

namespace sim {

class NearSolids {
 public:
  /// `footprint_radius` [m] is the largest distance of a point of the robot from its position.
  /// Keeps references to all three.
  NearSolids(const Solids& solids, const SensingWorld& sensing, SteppedWorld& stepped,
             double footprint_radius);
  ~NearSolids();
  NearSolids(const NearSolids&) = delete;
  NearSolids& operator=(const NearSolids&) = delete;

  /// To be called before each step: all that the robot at p_world_robot can touch is in the stepped world
  /// then.
  void follow(const Eigen::Vector2d& p_world_robot);

 private:
  using Present = std::map<int, btCollisionObject>;  // by solid: the same order in every run

  void stream(const Eigen::Vector2d& p_world_robot);
  void insert(int solid);
  btCollisionObject& new_object(int solid);

  const Solids& solids_;
  const SensingWorld& sensing_;
  SteppedWorld& stepped_;
  double reach_;                                     // [m] half size of the square that is kept filled
  std::optional<Eigen::Vector2d> p_world_streamed_;  // where the robot was when it was filled
  Present present_;
  std::vector<Present::node_type> spare_;  // of objects that were taken out
  std::vector<int> wanted_;
};

}  // namespace sim
