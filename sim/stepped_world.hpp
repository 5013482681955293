// The world that Bullet steps: the ground, the robots, and the solids near them.
#pragma once

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>

#include <cstddef>

namespace sim {

/// Which groups collide. Wheels and chassis overlap, and so must ignore each other. A wheel's contact shape is
/// larger than the wheel (see robot_body.hpp), so it collides with the ground only; in its place the chassis
/// collides with things.
struct CollisionGroup {
  static constexpr int ground = btBroadphaseProxy::StaticFilter;
  static constexpr int solid = 1 << 6;  // Bullet itself uses the groups up to 1 << 5
  static constexpr int chassis = 1 << 7;
  static constexpr int wheel = 1 << 8;

  static constexpr int ground_meets = chassis | wheel;
  static constexpr int solid_meets = chassis;
  static constexpr int chassis_meets = ground | solid | chassis;
  static constexpr int wheel_meets = ground;
};

class SteppedWorld {
 public:
  /// `robot_mass` [kg]: of each of the `robots` that will move in this world.
  SteppedWorld(double robot_mass, std::size_t robots);
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
