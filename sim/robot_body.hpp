// The robot's bodies, joints and motors.
//
// A chassis on two driven wheels and a caster. The origin of the robot frame is on the ground below the middle
// of the axle. Three choices make the encoders read what a real robot's encoders would read:
// - A wheel touches the ground with a sphere. A cylinder would touch it with a point of its edge that moves about;
//   it reads a turn of 20 rad on the spot wrong by 2 to 7 %.
// - A wheel is fixed to the chassis by a hinge with a motor. btRaycastVehicle computes the wheels' turning from
//   the chassis: its encoders would never see slip.
// - A motor is limited by the impulse that it may give in a step, torque times dt.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <Eigen/Core>

#include "sim/simulator.hpp"
#include "sim/stepped_world.hpp"
#include "worlds/world.hpp"

namespace sim {

/// The chassis in the robot frame: a box that covers the wheels and the caster from above, so that the chassis
/// is the part that collides with things.
struct ChassisBox {
  btVector3 min;  // [m]
  btVector3 max;  // [m]
};
ChassisBox chassis_box(const worlds::Robot& robot);

class RobotBody {
 public:
  /// Puts the robot at its start, at rest. Keeps a reference to the world. Throws std::invalid_argument if a
  /// mass, length or limit is not positive.
  RobotBody(const worlds::Robot& robot, const worlds::Physics& physics, SteppedWorld& world);
  ~RobotBody();
  RobotBody(const RobotBody&) = delete;
  RobotBody& operator=(const RobotBody&) = delete;

  /// To be called before each step of dt [s]. Sets the motors, and the friction of the ground below the wheels.
  /// Throws std::invalid_argument if the command is not finite.
  void drive(const Command& command, double dt);

  /// To be called after each step. Follows the joint angles when they wrap at +-pi.
  void read_joints();

  /// Moves all bodies together, with their velocities: as if the world had moved under the robot.
  void place(const worlds::Placement& T_world_robot);

  /// Another part of the ground with a friction of its own.
  void add_patch(const worlds::FrictionPatch& patch) { physics_.patches.push_back(patch); }

  Eigen::Vector2d position() const;

  /// The state without its time.
  RobotState state() const;

 private:
  struct Wheel {
    Wheel(const worlds::Robot& robot, btSphereShape& shape, btRigidBody& chassis,
          const btVector3& p_chassis_wheel);
    void read_joint();
    double angle() const;  // [rad] since the start, unwrapped

    btRigidBody body;
    btHingeConstraint hinge;
    double wrapped_angle = 0.0;  // [rad] in [-pi, pi]
    double turns = 0.0;          // [-] whole turns
  };

  void add_to_world(Wheel& wheel);
  void move(btRigidBody& body, const btTransform& T_new_old);

  worlds::Robot robot_;
  worlds::Physics physics_;
  btDiscreteDynamicsWorld& world_;
  btBoxShape box_shape_;
  btSphereShape caster_shape_;
  btSphereShape wheel_shape_;
  btCompoundShape chassis_shape_;
  btRigidBody chassis_;
  Wheel left_;
  Wheel right_;
  Command command_;  // after the limits were applied
};

}  // namespace sim
