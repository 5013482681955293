// The world that Bullet steps: the ground, and what the others put into it.
#pragma once

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>

namespace sim {

/// Who meets whom. The wheels and the chassis overlap and so must ignore each other; a wheel's contact shape
/// bulges beyond the wheel (see robot_body.hpp), so it meets the ground alone and the chassis bumps into
/// things for it.
struct CollisionGroup {
  static constexpr int ground = btBroadphaseProxy::StaticFilter;
  static constexpr int solid = 1 << 6;  // 1 << 5 is the last that Bullet uses itself
  static constexpr int chassis = 1 << 7;
  static constexpr int wheel = 1 << 8;

  static constexpr int ground_meets = chassis | wheel;
  static constexpr int solid_meets = chassis;
  static constexpr int chassis_meets = ground | solid;
  static constexpr int wheel_meets = ground;
};

class SteppedWorld {
 public:
  /// `robot_mass` [kg] of all that will move in it.
  explicit SteppedWorld(double robot_mass);
  ~SteppedWorld();
  SteppedWorld(const SteppedWorld&) = delete;
  SteppedWorld& operator=(const SteppedWorld&) = delete;

  /// One step of dt [s].
  void step(double dt);

  btDiscreteDynamicsWorld& bullet() { return world_; }
  int objects() const { return world_.getNumCollisionObjects(); }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btDantzigSolver dantzig_;
  btMLCPSolver solver_;
  btDiscreteDynamicsWorld world_;
  btStaticPlaneShape ground_shape_;
  btRigidBody ground_;
};

}  // namespace sim
