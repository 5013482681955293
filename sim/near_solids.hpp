// Keeps the solids near the robots, and only these, in the stepped world.
#pragma once

#include <btBulletCollisionCommon.h>

#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "sim/sensing_world.hpp"
#include "sim/solids.hpp"
#include "sim/stepped_world.hpp"

namespace sim {

class NearSolids {
 public:
  /// `footprint_radius` [m] is the largest distance of a point of a robot from its position. Keeps references
  /// to the first three arguments.
  NearSolids(const Solids& solids, const SensingWorld& sensing, SteppedWorld& stepped,
             double footprint_radius);
  ~NearSolids();
  NearSolids(const NearSolids&) = delete;
  NearSolids& operator=(const NearSolids&) = delete;

  /// To be called before each step. Afterwards everything that the robots at these places can touch is in the
  /// stepped world.
  void follow(std::span<const Eigen::Vector2d> p_world_robots);

  /// Something was put into the world: the next call of follow() looks for it.
  void look_again() { p_world_streamed_.clear(); }

 private:
  using Present = std::map<int, btCollisionObject>;  // sorted by solid: the same order in every run

  bool is_streamed(std::span<const Eigen::Vector2d> p_world_robots) const;
  void stream(std::span<const Eigen::Vector2d> p_world_robots);
  void insert(int solid);
  btCollisionObject& new_object(int solid);

  const Solids& solids_;
  const SensingWorld& sensing_;
  SteppedWorld& stepped_;
  double reach_;                                   // [m] half the side of the square around each robot
  std::vector<Eigen::Vector2d> p_world_streamed_;  // where the robots were at the last streaming
  Present present_;
  std::vector<Present::node_type> spare_;  // map nodes of objects that were taken out
  std::vector<int> wanted_;                // by all robots
  std::vector<int> of_one_;                // by one of them
};

}  // namespace sim
