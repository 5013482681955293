// The places of landmarks in a grid: finds the nearest ones.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace harness {

class LandmarkPlaces {
 public:
  struct Near {
    std::size_t index = 0;
    double distance = 0.0;  // [m]
  };

  explicit LandmarkPlaces(std::vector<Eigen::Vector2d> points);

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  /// The median of the distances from each point to the nearest other one. Empty for fewer than two points.
  /// [m]
  std::optional<double> spacing() const;

  /// The index of the nearest point within `radius` [m].
  std::optional<std::size_t> nearest(const Eigen::Vector2d& p, double radius) const;
  /// The nearest points within `radius` [m], the nearest first, at most `most`. It looks no farther than 24
  /// cells of about one point each. The reference is valid until the next call of a function of this object.
  const std::vector<Near>& near(const Eigen::Vector2d& p, double radius, std::size_t most) const;

 private:
  using Key = std::uint64_t;

  std::int64_t column(double coordinate) const;
  void add_cell(std::int64_t x, std::int64_t y, const Eigen::Vector2d& p, double radius) const;

  std::vector<Eigen::Vector2d> points_;
  double cell_;                                             // [m] edge of the grid's squares
  std::unordered_map<Key, std::vector<std::size_t>> grid_;  // indices of points
  mutable std::vector<Near> near_;                          // kept so that no search allocates
};

}  // namespace harness
