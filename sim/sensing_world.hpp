// The world of landmarks and obstacles that is asked and never stepped.
//
// Bullet walks every collision object at each step, static and far ones too (18 us at 100 objects, 19 ms at
// 100,000), while a ray or a box in its tree of bounding boxes costs the same at any number. So everything
// solid stands here, and only what is near the robot stands in the stepped world as well.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <btBulletCollisionCommon.h>

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

#include "sim/planar_geometry.hpp"
#include "sim/solids.hpp"

namespace sim {

/// The work that queries did so far.
struct QueryCounts {
  std::int64_t rays = 0;        // [-] rays cast
  std::int64_t candidates = 0;  // [-] solids that a query around a point looked at
};

/// Not thread-safe, const or not: Debian's Bullet shares one stack between the rays of a world.
class SensingWorld {
 public:
  /// Keeps a reference to the solids.
  explicit SensingWorld(const Solids& solids);
  ~SensingWorld();
  SensingWorld(const SensingWorld&) = delete;
  SensingWorld& operator=(const SensingWorld&) = delete;

  /// The solids whose bounding boxes meet the axis-aligned one, ascending; replaces what `out` held.
  void solids_in_box(const Eigen::Vector2d& min, const Eigen::Vector2d& max, std::vector<int>& out) const;

  /// The landmarks whose centres are within `radius` [m], ascending; replaces what `out` held.
  void landmarks_within(const Eigen::Vector2d& p_world, double radius, std::vector<int>& out) const;

  /// Whether a ray from p_world_sensor to the landmark's near face meets nothing else. From within the
  /// landmark it is free; from within something else nothing is seen.
  bool line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const;

  /// Whether everything solid is further than `radius` [m] from the way.
  bool path_is_clear(const Segment& way, double radius) const;

  const QueryCounts& counts() const { return counts_; }

 private:
  bool piece_is_clear(const Segment& piece, double radius, int ignored) const;

  const Solids& solids_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btNullPairCache no_pairs_;  // nothing moves here: pairs that overlap are of no interest
  btDbvtBroadphase broadphase_;
  std::deque<btCollisionObject> objects_;  // the world holds pointers to them, and follows them when it goes
  btCollisionWorld world_;
  mutable std::vector<int> nearby_;  // scratch of the queries
  mutable QueryCounts counts_;
};

}  // namespace sim
