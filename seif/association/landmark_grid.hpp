// Finds the landmarks near a point: a hash grid over their last known positions. The table
// grows by one list at a time (Litwin, "Linear hashing", VLDB 1980), so no landmark that joins costs a pass
// over the others.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

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
  explicit LandmarkGrid(double cell) : cell_(cell) { lists_.push_back(none); }

  /// Adds the next landmark.
  void add(const Eigen::Vector2d& p_world);
  void move(LandmarkId landmark, const Eigen::Vector2d& p_world);
  void remove(LandmarkId landmark);

  /// The nearest ones within `radius` [m], the nearest first, at most `max_count`; replaces what `out` held. Looks
  /// no farther than `most_rings` cells away.
  void find_near(const Eigen::Vector2d& p_world, double radius, std::size_t max_count,
                 std::vector<Near>& out) const;

  std::size_t memory_bytes() const { return lists_.memory_bytes() + landmarks_.memory_bytes(); }

 private:
  static constexpr int none = -1;
  static constexpr int most_rings = 24;
  static constexpr std::size_t landmarks_per_list = 2;  // [-] in the mean

  struct Cell {
    std::int64_t x = 0, y = 0;
    bool operator==(const Cell&) const = default;
  };
  struct Landmark {
    Eigen::Matrix<double, 2, 1, Eigen::DontAlign> p_world = Eigen::Vector2d::Zero();  // [m]
    Cell cell;
    int next = none;  // in its list
    bool is_in = false;
  };

  Landmark& landmark(int i) { return landmarks_[static_cast<std::size_t>(i)]; }
  const Landmark& landmark(int i) const { return landmarks_[static_cast<std::size_t>(i)]; }
  Cell cell_of(const Eigen::Vector2d& p_world) const;
  std::size_t list_of(const Cell& cell) const;
  void put_in(int i);
  void take_out(int i);
  void split();
  template <class Visit>
  void for_each_in_ring(const Cell& centre, int ring, Visit&& visit) const;

  double cell_;                 // [m]
  std::size_t round_ = 1;       // lists at the beginning of this round of splitting, a power of two
  std::size_t next_split_ = 0;  // [-] of these
  ChunkedArray<int> lists_;     // heads
  ChunkedArray<Landmark> landmarks_;
};

}  // namespace seif
