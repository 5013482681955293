// Where landmarks were when they joined: their places in the tree, which stay however closures move the map.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace seif {

/// How far the surroundings of the robot are from home.
class Homes {
 public:
  void begin() { offsets_.clear(); }
  /// A landmark in the window.
  void add(const Eigen::Vector2d& home, const Eigen::Vector2d& mean) { offsets_.push_back(home - mean); }
  /// Takes the offset of the landmark that has the smallest sum of distances to the others' offsets, so that the result
  /// turns with the frame of the world. Without landmarks everything stays. `far`: offsets farther apart belong to
  /// other parts of the map, which a closure has brought together [m].
  void finish(double far);

  /// From where something near the robot is. [m]
  const Eigen::Vector2d& offset() const { return offset_; }
  /// That of another part of the map, if there is one in the window. [m]
  const std::optional<Eigen::Vector2d>& other_offset() const { return other_; }

 private:
  Eigen::Vector2d offset_ = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> other_;
  std::vector<Eigen::Vector2d> offsets_;
};

}  // namespace seif
