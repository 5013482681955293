// The places of landmarks in a grid: finds the nearest ones.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "seif/association/landmark_grid.hpp"

namespace harness {

class LandmarkPlaces {
 public:
  using Near = seif::LandmarkGrid::Near;  // `landmark` is the index of a point

  explicit LandmarkPlaces(std::vector<Eigen::Vector2d> points);

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  /// The median of the distances from each point to the nearest other one. Empty for fewer than two points.
  /// [m]
  std::optional<double> spacing() const;

  /// The index of the nearest point within `radius` [m].
  std::optional<std::size_t> nearest(const Eigen::Vector2d& p, double radius) const;
  /// The nearest points within `radius` [m], the nearest first, at most `most`. The reference is valid until
  /// the next call of a function of this object.
  const std::vector<Near>& near(const Eigen::Vector2d& p, double radius, std::size_t most) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  seif::LandmarkGrid grid_;
  mutable std::vector<Near> near_;  // kept so that no search allocates
};

}  // namespace harness
