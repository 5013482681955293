#include "seif/association/constellation_index.hpp"

#include <algorithm>
#include <cmath>

namespace seif {

Triangle triangle_of(const std::array<int, 3>& points, const std::array<Eigen::Vector2d, 3>& at,
                     double least) {
  const Eigen::Vector2d ab = at[1] - at[0];
  const Eigen::Vector2d ac = at[2] - at[0];
  const double twice_area = ab.x() * ac.y() - ab.y() * ac.x();
  const std::array<std::size_t, 3> order =
      twice_area > 0.0 ? std::array<std::size_t, 3>{0, 1, 2} : std::array<std::size_t, 3>{0, 2, 1};
  std::array<double, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) sides[i] = (at[order[(i + 1) % 3]] - at[order[i]]).norm();
  const auto first = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  Triangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.corners[i] = points[order[(first + i) % 3]];
    triangle.sides(static_cast<Eigen::Index>(i)) = sides[(first + i) % 3];
  }
  triangle.is_sharp = triangle.sides.minCoeff() >= least && std::abs(twice_area) >= least * sides[first];
  return triangle;
}

std::int64_t ConstellationIndex::bin(double side) const {
  return static_cast<std::int64_t>(std::floor(side / width_));
}

std::uint64_t ConstellationIndex::hash_of(std::int64_t a, std::int64_t b, std::int64_t c) {
  return mixed(mixed(mixed(static_cast<std::uint64_t>(a)) + static_cast<std::uint64_t>(b)) +
               static_cast<std::uint64_t>(c));
}

bool ConstellationIndex::is_in(LandmarkId landmark) const {
  const auto i = static_cast<std::size_t>(landmark);
  return i < is_in_.size() && is_in_[i] != 0;
}

void ConstellationIndex::add(const LandmarkGrid& grid, LandmarkId landmark, double radius) {
  while (is_in_.size() <= static_cast<std::size_t>(landmark)) is_in_.push_back(0);
  if (is_in(landmark)) return;
  grid.find_near(grid.position(landmark), radius, 4 * neighbours, near_);
  std::erase_if(near_, [&](const LandmarkGrid::Near& near) { return !is_in(near.landmark); });
  if (near_.size() > neighbours) near_.resize(neighbours);
  is_in_[static_cast<std::size_t>(landmark)] = 1;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Corners corners{landmark, near_[i].landmark, near_[j].landmark};
      const Triangle triangle = triangle_of(
          corners, {grid.position(corners[0]), grid.position(corners[1]), grid.position(corners[2])}, width_);
      if (!triangle.is_sharp) continue;
      triangles_.push_back(triangle.corners);
      lists_.add(hash_of(bin(triangle.sides(0)), bin(triangle.sides(1)), bin(triangle.sides(2))));
    }
  }
}

}  // namespace seif
