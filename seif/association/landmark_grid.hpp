// Finds the landmarks near a point: a hash grid over their last known positions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "seif/association/hashed_lists.hpp"
#include "seif/chunked_array.hpp"
#include "seif/types.hpp"

namespace seif {

class LandmarkGrid {
 public:
  struct Near {
    LandmarkId landmark = no_landmark;
    double distance = 0.0;  // [m]
  };

  /// Cells of this width [m]. Landmarks have the ids 0, 1, 2, .. in the order in which they are added.
  explicit LandmarkGrid(double cell) : cell_(cell) {}

  /// Adds the next landmark.
  void add(const Eigen::Vector2d& p_world);
  void move(LandmarkId landmark, const Eigen::Vector2d& p_world);
  void remove(LandmarkId landmark);

  /// The nearest ones within `radius` [m], the nearest first, at most `max_count`; replaces what `out` held. Looks
  /// no farther than `most_rings` cells away.
  void find_near(const Eigen::Vector2d& p_world, double radius, std::size_t max_count,
                 std::vector<Near>& out) const;

  /// Where it was when it was last moved. [m]
  Eigen::Vector2d position(LandmarkId i) const { return landmark(i).p_world; }
  bool has(LandmarkId i) const { return lists_.is_in(i); }
  std::size_t size() const { return landmarks_.size(); }

  std::size_t memory_bytes() const { return lists_.memory_bytes() + landmarks_.memory_bytes(); }

 private:
  static constexpr int most_rings = 24;

  struct Cell {
    std::int64_t x = 0, y = 0;
    bool operator==(const Cell&) const = default;
  };
  struct Landmark {
    Eigen::Matrix<double, 2, 1, Eigen::DontAlign> p_world = Eigen::Vector2d::Zero();  // [m]
    Cell cell;
  };

  Landmark& landmark(int i) { return landmarks_[static_cast<std::size_t>(i)]; }
  const Landmark& landmark(int i) const { return landmarks_[static_cast<std::size_t>(i)]; }
  Cell cell_of(const Eigen::Vector2d& p_world) const;
  static std::uint64_t hash_of(const Cell& cell);
  template <class Visit>
  void for_each_in_ring(const Cell& centre, int ring, Visit&& visit) const;

  double cell_;  // [m]
  HashedLists lists_;
  ChunkedArray<Landmark> landmarks_;
};

}  // namespace seif
