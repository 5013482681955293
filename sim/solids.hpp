// Everything that blocks motion and sight, in one list: the landmarks first (index = id), then the boxes,
// then the walls segment by segment.
#pragma once

#include <btBulletCollisionCommon.h>

#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sim/planar_geometry.hpp"
#include "worlds/world.hpp"

namespace sim {

class Solids {
 public:
  /// Throws std::invalid_argument for a size that is not positive, or a wall of fewer than two points.
  explicit Solids(const worlds::World& world);

  int size() const { return static_cast<int>(disks_.size() + rectangles_.size()); }
  bool is_landmark(int solid) const { return solid < static_cast<int>(disks_.size()); }
  const Disk& landmark(int landmark) const { return disks_[static_cast<std::size_t>(landmark)]; }

  /// Shortest distance in the plane; 0 if they touch. [m]
  double distance_to(int solid, const Segment& way) const;

  /// The solid's shape, shared by all solids of the same size, and its position.
  btCollisionShape& shape(int solid) const { return *shapes_[static_cast<std::size_t>(solid)]; }
  btTransform T_world_solid(int solid) const;

 private:
  using Size = std::pair<double, double>;  // [m] (radius, 0) or half sizes

  void add_landmark(const worlds::Landmark& landmark);
  void add_wall(const worlds::Wall& wall);
  void add_rectangle(const Rectangle& rectangle);
  const Rectangle& rectangle(int solid) const;

  double half_height_;  // [m]
  std::vector<Disk> disks_;
  std::vector<Rectangle> rectangles_;
  std::vector<btCollisionShape*> shapes_;  // of each solid
  std::map<Size, std::unique_ptr<btCylinderShapeZ>> cylinders_;
  std::map<Size, std::unique_ptr<btBoxShape>> boxes_;
};

}  // namespace sim
