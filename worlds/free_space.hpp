// Finds out where a landmark can stand. The cost of a query does not grow with the number of landmarks, and with
// the logarithm of that of walls and of legs of the path.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "worlds/geometry.hpp"
#include "worlds/point_grid.hpp"
#include "worlds/shape_tree.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// The least distances from the surface of a landmark to other things.
struct Clearances {
  double walls = 0.3;      // [m] from the surfaces of walls and boxes
  double path = 0.6;       // [m] from the line that the robot is meant to drive
  double landmarks = 0.3;  // [m] from the surfaces of other landmarks
};

/// The part of a world that is free for landmarks of one size.
class FreeSpace {
 public:
  /// The part of the ground that keeps clear of everything in the world, including its present landmarks.
  /// Landmarks that are added later keep `own_distance` [m] between their centres.
  FreeSpace(const World& world, double radius, const Clearances& clear, double own_distance);

  /// Whether a landmark can stand at p: wholly on the ground, and clear of everything in the world.
  bool is_free(const Eigen::Vector2d& p) const;

  void add(const Eigen::Vector2d& p);

 private:
  /// The shapes from which landmarks keep away; enters the distances of their centres.
  std::vector<Rectangle> keep_outs(const World& world, const Clearances& clear);

  Eigen::Vector2d ground_size_;     // [m]
  double radius_;                   // [m]
  double own_distance_;             // [m]
  double clear_landmarks_;          // [m]
  std::size_t foreign_count_;       // [-] points below this index were in the world before
  std::vector<double> radii_;       // [m] of all landmarks
  PointGrid points_;                // of all landmarks
  std::vector<double> clearances_;  // [m] for each keep-out: least distance to a landmark's centre
  ShapeTree keep_outs_;
};

}  // namespace worlds
