// The world in the Bullet physics engine: robots with masses, motors and contacts, among solid things that hide each
// other from the sensors.
//
// There are two collision worlds. The stepped one holds the ground, the robots and the solid things near them;
// things are inserted and removed as the robots move. The sensing one holds every landmark and obstacle and is
// never stepped. So neither a step nor a scan costs more in a world with more landmarks.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "sim/near_solids.hpp"
#include "sim/planar_geometry.hpp"
#include "sim/robot_body.hpp"
#include "sim/sensing_world.hpp"
#include "sim/simulator.hpp"
#include "sim/solids.hpp"
#include "sim/stepped_world.hpp"
#include "worlds/geometry.hpp"

namespace sim {

class BulletArena {
 public:
  /// See make_simulator. The step rate is positive, and there is a place for each robot.
  BulletArena(const worlds::World& world, std::span<const worlds::Placement> starts);

  std::size_t robots() const { return robots_.size(); }

  /// What this robot does in the next step. The world is stepped once each robot has been told. Throws
  /// std::invalid_argument if the command is not finite.
  void command(std::size_t robot, const Command& command);

  void place(std::size_t robot, const worlds::Placement& T_world_robot);
  RobotState state(std::size_t robot) const;

  int add_landmark(const worlds::Landmark& landmark);
  void add_wall(const worlds::Wall& wall);
  void add_patch(const worlds::FrictionPatch& patch);

  const SensingWorld& sensing() const { return sensing_; }
  const Solids& solids() const { return solids_; }
  /// Whether the chassis of every robot but this one is farther than `radius` [m] from the way.
  bool is_clear_of_others(std::size_t robot, const Segment& way, double radius) const;
  SimulatorCounts counts() const;

 private:
  void step();
  void insert_from(int first);
  Rectangle chassis(std::size_t robot) const;

  // Members are destroyed from the last to the first: things leave the stepped world before it is destroyed.
  int step_rate_;            // [Hz]
  double footprint_radius_;  // [m] of a robot
  worlds::Footprint footprint_;
  Solids solids_;
  SensingWorld sensing_;
  SteppedWorld stepped_;
  std::deque<RobotBody> robots_;
  NearSolids near_solids_;
  std::size_t told_ = 0;                    // [-] robots that know what to do in the next step
  std::vector<Eigen::Vector2d> positions_;  // [m] of the robots; reused from step to step
  std::int64_t steps_ = 0;                  // [-]
  std::int64_t objects_stepped_ = 0;        // [-]
};

}  // namespace sim
