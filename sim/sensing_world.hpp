// The collision world of all landmarks and obstacles. It answers queries and is never stepped.
//
// At each step Bullet visits every collision object, static and distant ones too (18 us at 100 objects, 19 ms
// at 100,000). A ray or a box query in its tree of bounding boxes costs the same at any number. So everything
// solid is in this world, and only the things near the robot are in the stepped world as well.
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

/// The work of all queries so far.
struct QueryCounts {
  std::int64_t rays = 0;        // [-] rays cast
  std::int64_t candidates = 0;  // [-] solids that the queries around a point examined
};

/// Not thread-safe, not even the const functions: Debian's Bullet shares one stack between the rays of a world.
class SensingWorld {
 public:
  /// Keeps a reference to the solids.
  explicit SensingWorld(const Solids& solids);
  ~SensingWorld();
  SensingWorld(const SensingWorld&) = delete;
  SensingWorld& operator=(const SensingWorld&) = delete;

  /// To be called for each thing that is added to the solids.
  void insert(int solid);

  /// The solids whose bounding boxes overlap the axis-aligned box, ascending; replaces the content of `out`.
  void solids_in_box(const Eigen::Vector2d& min, const Eigen::Vector2d& max, std::vector<int>& out) const;

  /// Indices of the landmarks whose centres are within `radius` [m], ascending; replaces the content of `out`.
  void landmarks_within(const Eigen::Vector2d& p_world, double radius, std::vector<int>& out) const;

  /// Whether a ray from p_world_sensor to the near face of the landmark hits nothing else. True if the sensor
  /// is inside the landmark; false if it is inside another solid.
  bool line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const;

  /// Whether all solids are farther than `radius` [m] from the path.
  bool path_is_clear(const Segment& way, double radius) const;

  const QueryCounts& counts() const { return counts_; }

 private:
  bool piece_is_clear(const Segment& piece, double radius, int ignored) const;

  const Solids& solids_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btNullPairCache no_pairs_;  // nothing moves here, so overlapping pairs are not needed
  btDbvtBroadphase broadphase_;
  std::deque<btCollisionObject> objects_;  // the world points to them, and is destroyed before them
  btCollisionWorld world_;
  mutable std::vector<int> nearby_;  // scratch memory of the queries
  mutable QueryCounts counts_;
};

}  // namespace sim
