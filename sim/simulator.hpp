// The physical truth: a differential-drive robot and its surroundings, other robots among them. The rest of the program sees only this
// interface; the world file says which engine implements it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "worlds/world.hpp"

namespace sim {

/// What the robot is told to do. Its limits and motors decide what it does.
struct Command {
  double v = 0.0;      // [m/s] forward
  double omega = 0.0;  // [rad/s] counter-clockwise
};

/// The true state of the robot.
struct RobotState {
  double t = 0.0;                                      // [s] since the start
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world_robot, of the middle of the axle [m]
  double heading = 0.0;                                // [rad] in (-pi, pi]
  double left_wheel = 0.0;                             // [rad] joint angle since the start, unwrapped
  double right_wheel = 0.0;                            // [rad] joint angle since the start, unwrapped
  double v = 0.0;                                      // [m/s] along the heading
  double omega = 0.0;                                  // [rad/s]
};

/// The work done so far. It must not grow with the number of landmarks.
struct SimulatorCounts {
  std::int64_t steps = 0;            // [-] physics steps
  std::int64_t objects_stepped = 0;  // [-] collision objects in the stepped world, summed over the steps
  std::int64_t rays = 0;             // [-] rays cast
  std::int64_t candidates = 0;       // [-] objects that the queries around a point examined
};

/// One simulated world. The same world and build give the same bits. Not thread-safe: use each simulator in one
/// thread.
class Simulator {
 public:
  virtual ~Simulator() = default;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// Advances the world by one physics step, 1 / step_rate. Throws std::invalid_argument if the command is not
  /// finite. Several robots of one world share its step: it is made when each of them has been told its command.
  virtual void step(const Command& command) = 0;

  /// Puts the robot at another place while it moves: its speeds in its own frame stay, and so do its wheels'
  /// angles. Throws std::invalid_argument if the place is not finite.
  virtual void place(const worlds::Placement& T_world_robot) = 0;

  virtual RobotState robot() const = 0;

  /// Puts a landmark into the world, and returns its index, which is the next one. Throws std::invalid_argument if
  /// its radius is not positive, or if the robot stands there; then nothing has changed.
  virtual int add_landmark(const worlds::Landmark& landmark) = 0;

  /// The same for a wall. Throws std::invalid_argument in an engine without walls, too.
  virtual void add_wall(const worlds::Wall& wall) = 0;

  /// Gives a part of the ground another friction; where patches overlap, the latest counts. Throws
  /// std::invalid_argument in an engine without friction.
  virtual void add_patch(const worlds::FrictionPatch& patch) = 0;

  /// Indices of the landmarks whose centre is within `radius` [m] of p_world, ascending; replaces the content
  /// of `out`.
  virtual void landmarks_within(const Eigen::Vector2d& p_world, double radius,
                                std::vector<int>& out) const = 0;

  /// Whether nothing except the landmark itself is between p_world_sensor and the near face of that landmark.
  /// Throws std::out_of_range if no landmark has this index.
  virtual bool line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const = 0;

  /// Whether a disk of `radius` [m] can move straight from one point to the other without touching a landmark
  /// or an obstacle, its start included.
  virtual bool path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                             double radius) const = 0;

  virtual SimulatorCounts counts() const = 0;

 protected:
  Simulator() = default;
};

/// Makes the engine that the world names; the engine copies what it needs of the world. Throws
/// std::invalid_argument for values that the engine cannot use: a step rate, mass, length or limit that is not
/// positive, a wall of fewer than two points, and in the kinematic engine any obstacle or patch.
std::unique_ptr<Simulator> make_simulator(const worlds::World& world);

/// The same for a world of several robots: one simulator for each, in the order of the world. In Bullet they share
/// the world, so they collide, and hide landmarks from each other. In the kinematic engine they do not meet.
std::vector<std::unique_ptr<Simulator>> make_team(const worlds::World& world);

}  // namespace sim
