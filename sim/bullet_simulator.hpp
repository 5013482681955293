// The world in the Bullet physics engine: a robot with masses, motors and contacts, among solid things that
// hide each other from the sensor.
//
// There are two collision worlds. The stepped one holds the ground, the robot and the solid things near it;
// things are inserted and removed as the robot moves. The sensing one holds every landmark and obstacle and is
// never stepped. So neither a step nor a scan costs more in a world with more landmarks.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/near_solids.hpp"
#include "sim/robot_body.hpp"
#include "sim/sensing_world.hpp"
#include "sim/simulator.hpp"
#include "sim/solids.hpp"
#include "sim/stepped_world.hpp"

namespace sim {

class BulletSimulator final : public Simulator {
 public:
  /// See make_simulator. The step rate is positive.
  explicit BulletSimulator(const worlds::World& world);

  void step(const Command& command) override;
  void place(const worlds::Placement& T_world_robot) override;
  RobotState robot() const override;
  int add_landmark(const worlds::Landmark& landmark) override;
  void add_wall(const worlds::Wall& wall) override;
  void add_patch(const worlds::FrictionPatch& patch) override { robot_.add_patch(patch); }
  void landmarks_within(const Eigen::Vector2d& p_world, double radius, std::vector<int>& out) const override;
  bool line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const override;
  bool path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                     double radius) const override;
  SimulatorCounts counts() const override;

 private:
  void insert_from(int first);

  // Members are destroyed from the last to the first: things leave the stepped world before it is destroyed.
  int step_rate_;            // [Hz]
  double footprint_radius_;  // [m] of the robot
  Solids solids_;
  SensingWorld sensing_;
  SteppedWorld stepped_;
  RobotBody robot_;
  NearSolids near_solids_;
  std::int64_t steps_ = 0;            // [-]
  std::int64_t objects_stepped_ = 0;  // [-]
};

}  // namespace sim
