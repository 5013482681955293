// Everything that blocks motion and sight, in one list: first the landmarks of the world (index = id), then the boxes,
// then the walls segment by segment, and then what was added later.
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

  /// Adds a landmark, or the segments of a wall. Throws as the constructor does; then nothing has changed.
  void add(const worlds::Landmark& landmark);
  void add(const worlds::Wall& wall);
  /// Takes out the things that were added last, from this one on.
  void remove_from(int solid);

  int size() const { return static_cast<int>(shapes_.size()); }
  int landmarks() const { return static_cast<int>(disks_.size()); }
  bool is_landmark(int solid) const;
  const Disk& landmark(int landmark) const { return disks_[static_cast<std::size_t>(landmark)]; }
  /// The disk of a solid that is a landmark.
  const Disk& disk(int solid) const { return landmark(landmark_of(solid)); }
  /// The index of the landmark that this solid is; and the other way round.
  int landmark_of(int solid) const;
  int solid_of(int landmark) const;

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

  /// What was added after the world's own things.
  struct Added {
    bool is_landmark = false;
    int number = 0;  // among the landmarks, or among the rectangles
  };

  const Added* added(int solid) const;

  double half_height_;        // [m]
  int first_landmarks_ = 0;   // [-] of the world
  int first_rectangles_ = 0;  // [-] of the world
  std::vector<Added> added_;
  std::vector<int> added_landmarks_;  // the solid of each
  std::vector<Disk> disks_;
  std::vector<Rectangle> rectangles_;
  std::vector<btCollisionShape*> shapes_;  // of each solid
  std::map<Size, std::unique_ptr<btCylinderShapeZ>> cylinders_;
  std::map<Size, std::unique_ptr<btBoxShape>> boxes_;
};

}  // namespace sim
