#include "sim/sensing_world.hpp"

#include <algorithm>
#include <cmath>

namespace sim {

namespace {

constexpr int nothing = -1;

int index_of(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject)->getUserIndex();
}

/// Collects the solids that the tree of bounding boxes reports.
struct Gather : btBroadphaseAabbCallback {
  explicit Gather(std::vector<int>& into) : out(into) {}
  bool process(const btBroadphaseProxy* proxy) override {
    out.push_back(index_of(*proxy));
    return true;
  }
  std::vector<int>& out;
};

/// Whether the ray hits anything except the target.
struct AnyOtherHit : btCollisionWorld::RayResultCallback {
  explicit AnyOtherHit(int target_solid) : target(target_solid) {}
  bool needsCollision(btBroadphaseProxy* proxy) const override { return index_of(*proxy) != target; }
  btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool) override {
    m_collisionObject = result.m_collisionObject;
    m_closestHitFraction = 0.0;  // one hit is enough: Bullet then tests no other object
    return m_closestHitFraction;
  }
  int target;
};

/// No contact is ever computed here, so the pools of contacts, which take megabytes by default, get their
/// smallest size.
btDefaultCollisionConstructionInfo without_contacts() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 1;
  info.m_defaultMaxCollisionAlgorithmPoolSize = 1;
  return info;
}

}  // namespace

SensingWorld::SensingWorld(const Solids& solids)
    : solids_(solids),
      configuration_(without_contacts()),
      dispatcher_(&configuration_),
      broadphase_(&no_pairs_),
      world_(&dispatcher_, &broadphase_, &configuration_) {
  broadphase_.m_deferedcollide = true;  // do not look for pairs at each insertion
  for (int i = 0; i < solids_.size(); ++i) insert(i);
  broadphase_.optimize();  // builds one balanced tree; insertion one by one gives a worse one
}

SensingWorld::~SensingWorld() = default;

void SensingWorld::insert(int solid) {
  btCollisionObject& object = objects_.emplace_back();
  object.setCollisionShape(&solids_.shape(solid));
  object.setWorldTransform(solids_.T_world_solid(solid));
  object.setUserIndex(solid);
  world_.addCollisionObject(&object, btBroadphaseProxy::StaticFilter, btBroadphaseProxy::AllFilter);
}

void SensingWorld::solids_in_box(const Eigen::Vector2d& min, const Eigen::Vector2d& max,
                                 std::vector<int>& out) const {
  out.clear();
  Gather gather(out);
  // Bullet's query is not const, but changes nothing.
  const_cast<btDbvtBroadphase&>(broadphase_)
      .aabbTest(btVector3(min.x(), min.y(), 0.0), btVector3(max.x(), max.y(), 0.0), gather);
  counts_.candidates += static_cast<std::int64_t>(out.size());
  std::sort(out.begin(), out.end());  // the tree's order has no meaning
}

void SensingWorld::landmarks_within(const Eigen::Vector2d& p_world, double radius,
                                    std::vector<int>& out) const {
  const Eigen::Vector2d reach(radius, radius);
  solids_in_box(p_world - reach, p_world + reach, out);
  std::erase_if(out, [&](int solid) {
    return !solids_.is_landmark(solid) || (solids_.disk(solid).centre - p_world).norm() > radius;
  });
  for (int& solid : out)
    solid = solids_.landmark_of(solid);  // still ascending: later landmarks are later solids
}

bool SensingWorld::line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const {
  const Disk& target = solids_.landmark(landmark);
  const Eigen::Vector2d to_sensor = p_world_sensor - target.centre;
  const double range = to_sensor.norm();
  if (range <= target.radius) {
    return true;
  }
  // Bullet's ray ignores a convex shape that it starts in.
  const int solid = solids_.solid_of(landmark);
  if (!piece_is_clear({p_world_sensor, p_world_sensor}, 0.0, solid)) {
    return false;
  }
  const Eigen::Vector2d p_world_face = target.centre + target.radius / range * to_sensor;
  AnyOtherHit hit(solid);
  world_.rayTest(btVector3(p_world_sensor.x(), p_world_sensor.y(), 0.0),
                 btVector3(p_world_face.x(), p_world_face.y(), 0.0), hit);
  ++counts_.rays;
  return !hit.hasHit();
}

bool SensingWorld::path_is_clear(const Segment& way, double radius) const {
  // The bounding box of a long diagonal path would contain many solids that are far from it, so the path is
  // tested in pieces.
  constexpr double longest_piece = 4.0;  // [m]
  const Eigen::Vector2d along = way.end - way.start;
  const int pieces = std::max(1, static_cast<int>(std::ceil(along.norm() / longest_piece)));
  for (int i = 0; i < pieces; ++i) {
    const Segment piece{way.start + along * (static_cast<double>(i) / pieces),
                        way.start + along * (static_cast<double>(i + 1) / pieces)};
    if (!piece_is_clear(piece, radius, nothing)) {
      return false;
    }
  }
  return true;
}

/// Exact distances in the plane decide: Bullet's convex sweep would report a start in contact as free.
bool SensingWorld::piece_is_clear(const Segment& piece, double radius, int ignored) const {
  const Eigen::Vector2d reach(radius, radius);
  solids_in_box(piece.start.cwiseMin(piece.end) - reach, piece.start.cwiseMax(piece.end) + reach, nearby_);
  return std::none_of(nearby_.begin(), nearby_.end(), [&](int solid) {
    return solid != ignored && solids_.distance_to(solid, piece) <= radius;
  });
}

}  // namespace sim
