// Finds triangles of landmarks by the lengths of their sides, which are the same wherever and however the robot stands.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "seif/association/hashed_lists.hpp"
#include "seif/association/landmark_grid.hpp"
#include "seif/chunked_array.hpp"
#include "seif/types.hpp"

namespace seif {

/// Three points counter-clockwise, the longest side from the first to the second.
struct Triangle {
  std::array<int, 3> corners = {};                  // numbers of points
  Eigen::Vector3d sides = Eigen::Vector3d::Zero();  // [m] from each corner to the next
  bool is_sharp = false;                            // no side and no height is so short that noise hides it
};

/// `least`: of sides and heights [m].
Triangle triangle_of(const std::array<int, 3>& points, const std::array<Eigen::Vector2d, 3>& at,
                     double least);

class ConstellationIndex {
 public:
  static constexpr std::size_t neighbours = 6;  // [-] of a landmark, among which its triangles are

  /// Sides that differ by less than half of `width` [m] are found as alike.
  explicit ConstellationIndex(double width) : width_(width) {}
  double width() const { return width_; }

  /// The triangles of a landmark with the nearest landmarks that are in the index. Constant time; the landmarks have
  /// the ids 0, 1, 2, .., and may be added in any order.
  void add(const LandmarkGrid& grid, LandmarkId landmark, double radius);

  /// Calls visit(corners) for each triangle of the map with about these sides: all that differ by less than half a
  /// width, and some that differ by less than two.
  template <class Visit>
  void for_each_like(const Eigen::Vector3d& sides, Visit&& visit) const {
    std::array<std::array<std::int64_t, 2>, 3> bins;
    for (int i = 0; i < 3; ++i)
      bins[static_cast<std::size_t>(i)] = {bin(sides(i) - 0.5 * width_), bin(sides(i) + 0.5 * width_)};
    for (const std::int64_t a : bins[0])
      for (const std::int64_t b : bins[1])
        for (const std::int64_t c : bins[2])
          lists_.for_each(hash_of(a, b, c), [&](int i) { visit(triangles_[static_cast<std::size_t>(i)]); });
  }

  std::size_t size() const { return triangles_.size(); }
  std::size_t memory_bytes() const {
    return lists_.memory_bytes() + triangles_.memory_bytes() + is_in_.memory_bytes();
  }

 private:
  using Corners = std::array<LandmarkId, 3>;

  std::int64_t bin(double side) const;
  static std::uint64_t hash_of(std::int64_t a, std::int64_t b, std::int64_t c);
  bool is_in(LandmarkId landmark) const;

  double width_;  // [m]
  HashedLists lists_;
  ChunkedArray<Corners> triangles_;
  ChunkedArray<char> is_in_;  // by landmark
  std::vector<LandmarkGrid::Near> near_;
};

}  // namespace seif
