#include "sim/robot_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/drive_limits.hpp"
#include "sim/ground_friction.hpp"
#include "sim/planar_geometry.hpp"
#include "worlds/geometry.hpp"

namespace sim {

namespace {

// The centre of mass, as a fraction of the distance from the axle to the caster. With 30 % of the weight on the
// caster, the robot does not tip under full brakes (up to 0.3 * 0.18 m / 0.1 m * g = 5 m/s^2 with the standard
// robot), and the wheels keep their grip.
constexpr double centre_of_mass_share = 0.3;

worlds::Robot checked(const worlds::Robot& robot) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  check_drive(robot);
  if (!positive(robot.wheel_mass) || !(robot.mass > 2.0 * robot.wheel_mass) || !positive(robot.mass)) {
    throw std::invalid_argument(
        "simulator: the robot must weigh more than its two wheels, and those something");
  }
  if (!positive(robot.caster.radius) || !positive(robot.motor_torque)) {
    throw std::invalid_argument("simulator: the robot's caster radius and torque must be positive");
  }
  return robot;
}

btTransform T_world_robot(const worlds::Placement& start) {
  return btTransform(btQuaternion(btVector3(0.0, 0.0, 1.0), start.heading),
                     btVector3(start.position.x(), start.position.y(), 0.0));
}

/// The chassis' centre of mass and origin, at the height of the axle.
btVector3 p_robot_chassis(const worlds::Robot& robot) {
  return btVector3(centre_of_mass_share * robot.caster.offset, 0.0, robot.wheel_radius);
}

btVector3 half_extents(const ChassisBox& box) { return 0.5 * (box.max - box.min); }

btRigidBody make_body(double mass, btCollisionShape& shape, const btVector3& inertia,
                      const btTransform& T_world_body) {
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
  info.m_startWorldTransform = T_world_body;
  return btRigidBody(info);
}

btRigidBody make_chassis(const worlds::Robot& robot, btCompoundShape& shape, const btBoxShape& box) {
  const double mass = robot.mass - 2.0 * robot.wheel_mass;
  btVector3 inertia;
  box.calculateLocalInertia(mass, inertia);
  btTransform T_robot_chassis = btTransform::getIdentity();
  T_robot_chassis.setOrigin(p_robot_chassis(robot));
  return make_body(mass, shape, inertia, T_world_robot(robot.start) * T_robot_chassis);
}

/// The inertia of a solid disk about its y axis.
btVector3 wheel_inertia(const worlds::Robot& robot) {
  const double r2 = robot.wheel_radius * robot.wheel_radius;
  const double width = worlds::wheel_width(robot);
  const double across = robot.wheel_mass * (r2 / 4.0 + width * width / 12.0);
  return btVector3(across, robot.wheel_mass * r2 / 2.0, across);
}

}  // namespace

ChassisBox chassis_box(const worlds::Robot& robot) {
  const worlds::Footprint footprint = worlds::footprint(robot);
  // Below the axle and above the ground: if the robot tips, this edge slides on the ground and supports it.
  const double bottom = 0.5 * std::min(robot.wheel_radius, robot.caster.radius);
  return {btVector3(footprint.min.x(), footprint.min.y(), bottom),
          btVector3(footprint.max.x(), footprint.max.y(), 2.0 * robot.wheel_radius)};
}

RobotBody::Wheel::Wheel(const worlds::Robot& robot, btSphereShape& shape, btRigidBody& chassis,
                        const btVector3& p_chassis_wheel)
    : body(make_body(robot.wheel_mass, shape, wheel_inertia(robot),
                     btTransform(chassis.getWorldTransform().getBasis(),
                                 chassis.getWorldTransform() * p_chassis_wheel))),
      // The wheel is the first body of the joint: it then turns forwards about +y, the axle's direction to the
      // left.
      hinge(body, chassis, btVector3(0.0, 0.0, 0.0), p_chassis_wheel, btVector3(0.0, 1.0, 0.0),
            btVector3(0.0, 1.0, 0.0)) {
  wrapped_angle = hinge.getHingeAngle();
}

void RobotBody::Wheel::read_joint() {
  const double now = hinge.getHingeAngle();
  const double change = now - wrapped_angle;
  turns += change > std::numbers::pi ? -1.0 : change < -std::numbers::pi ? 1.0 : 0.0;
  wrapped_angle = now;
}

double RobotBody::Wheel::angle() const { return wrapped_angle + 2.0 * std::numbers::pi * turns; }

RobotBody::RobotBody(const worlds::Robot& robot, const worlds::Physics& physics, SteppedWorld& world)
    : robot_(checked(robot)),
      physics_(physics),
      world_(world.bullet()),
      box_shape_(half_extents(chassis_box(robot))),
      caster_shape_(robot.caster.radius),
      wheel_shape_(robot.wheel_radius),
      chassis_(make_chassis(robot, chassis_shape_, box_shape_)),
      left_(robot, wheel_shape_, chassis_,
            btVector3(0.0, 0.5 * robot.track, robot.wheel_radius) - p_robot_chassis(robot)),
      right_(robot, wheel_shape_, chassis_,
             btVector3(0.0, -0.5 * robot.track, robot.wheel_radius) - p_robot_chassis(robot)) {
  const ChassisBox box = chassis_box(robot);
  const auto add = [&](btCollisionShape& shape, const btVector3& p_robot_shape) {
    btTransform T_chassis_shape = btTransform::getIdentity();
    T_chassis_shape.setOrigin(p_robot_shape - p_robot_chassis(robot));
    chassis_shape_.addChildShape(T_chassis_shape, &shape);
  };
  add(box_shape_, 0.5 * (box.min + box.max));
  add(caster_shape_, btVector3(robot.caster.offset, 0.0, robot.caster.radius));
  // A body has one coefficient of friction. With zero, the caster rolls freely, and the chassis slides along
  // the things that it hits.
  chassis_.setFriction(0.0);
  chassis_.setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(&chassis_, CollisionGroup::chassis, CollisionGroup::chassis_meets);
  add_to_world(left_);
  add_to_world(right_);
}

RobotBody::~RobotBody() {
  for (Wheel* wheel : {&left_, &right_}) {
    world_.removeConstraint(&wheel->hinge);
    world_.removeRigidBody(&wheel->body);
  }
  world_.removeRigidBody(&chassis_);
}

void RobotBody::add_to_world(Wheel& wheel) {
  wheel.body.setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(&wheel.body, CollisionGroup::wheel, CollisionGroup::wheel_meets);
  world_.addConstraint(&wheel.hinge);
}

void RobotBody::drive(const Command& command, double dt) {
  command_ = limited(command, command_, robot_, dt);
  const WheelSpeeds speeds = wheel_speeds(command_, robot_);
  const double impulse = robot_.motor_torque * dt;
  left_.hinge.enableAngularMotor(true, speeds.left, impulse);
  right_.hinge.enableAngularMotor(true, speeds.right, impulse);
  for (Wheel* wheel : {&left_, &right_}) {
    const btVector3& p = wheel->body.getWorldTransform().getOrigin();
    // Contacts with a plane read the coefficient again at every step.
    wheel->body.setFriction(ground_friction(physics_, {p.x(), p.y()}));
  }
}

void RobotBody::read_joints() {
  left_.read_joint();
  right_.read_joint();
}

void RobotBody::place(const worlds::Placement& placement) {
  const worlds::Placement now{position(), state().heading};
  const btTransform T_new_old = T_world_robot(placement) * T_world_robot(now).inverse();
  move(chassis_, T_new_old);
  move(left_.body, T_new_old);
  move(right_.body, T_new_old);
}

void RobotBody::move(btRigidBody& body, const btTransform& T_new_old) {
  const btTransform T_world_body = T_new_old * body.getWorldTransform();
  const btVector3 v = T_new_old.getBasis() * body.getLinearVelocity();
  const btVector3 omega = T_new_old.getBasis() * body.getAngularVelocity();
  body.setLinearVelocity(v);
  body.setAngularVelocity(omega);
  body.setCenterOfMassTransform(T_world_body);
  body.setInterpolationLinearVelocity(v);
  body.setInterpolationAngularVelocity(omega);
  // Contacts store old positions, so they are removed.
  world_.getBroadphase()->getOverlappingPairCache()->cleanProxyFromPairs(body.getBroadphaseProxy(),
                                                                         world_.getDispatcher());
  world_.updateSingleAabb(&body);
}

Eigen::Vector2d RobotBody::position() const {
  const btVector3 p = chassis_.getWorldTransform() * -p_robot_chassis(robot_);
  return {p.x(), p.y()};
}

RobotState RobotBody::state() const {
  const btTransform& T_world_chassis = chassis_.getWorldTransform();
  const btVector3 forward = T_world_chassis.getBasis().getColumn(0);
  const btVector3 p_chassis_axle = T_world_chassis.getBasis() * -p_robot_chassis(robot_);
  RobotState state;
  state.position = position();
  state.heading = heading_of({forward.x(), forward.y()});
  state.left_wheel = left_.angle();
  state.right_wheel = right_.angle();
  state.v = chassis_.getVelocityInLocalPoint(p_chassis_axle).dot(forward);
  state.omega = chassis_.getAngularVelocity().z();
  return state;
}

}  // namespace sim
