// An index of landmarks by position. It finds those in a rectangle without a pass over all landmarks.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "seif/types.hpp"

namespace harness {

/// An axis-aligned rectangle of the ground.
struct Area {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d max = Eigen::Vector2d::Zero();  // [m]
};

class PointIndex {
 public:
  /// `cell` [m]: the edge of the grid's squares.
  explicit PointIndex(double cell) : cell_(cell) {}

  /// Adds a point, or moves one.
  void put(seif::LandmarkId id, const Eigen::Vector2d& position);

  std::size_t size() const { return points_.size(); }
  /// The id of the point with this number. Points are numbered in the order in which they were added.
  seif::LandmarkId id(std::size_t number) const { return points_[number].id; }
  std::optional<Eigen::Vector2d> position(seif::LandmarkId id) const;

  /// The points in the area, and some near it, always in the same order. Overwrites `out`.
  void within(const Area& area, std::vector<seif::LandmarkId>& out) const;

 private:
  using Key = std::uint64_t;
  struct Point {
    seif::LandmarkId id;
    Eigen::Vector2d position;
  };

  std::int32_t column(double coordinate) const;
  static Key key(std::int32_t column, std::int32_t row);
  Key key(const Eigen::Vector2d& position) const;

  double cell_;
  std::vector<Point> points_;
  std::unordered_map<seif::LandmarkId, std::size_t> numbers_;
  std::unordered_map<Key, std::vector<seif::LandmarkId>> cells_;
};

}  // namespace harness
