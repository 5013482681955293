// Maps of scattered landmarks, and what a robot among them sees.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "seif/types.hpp"

namespace seif::test {

using Points = std::vector<Eigen::Vector2d>;  // [m]

inline constexpr double sighting_sd = 0.05;  // [m]
inline constexpr double reach = 6.0;         // [m]

/// In a square of this width [m], with a corner at the origin.
inline Points scattered(int count, double width, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0.0, width);
  Points points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(random), place(random));
  return points;
}

/// What a robot at T_world_robot has around it, with errors, in its own frame: at most so many, the nearest first.
inline Points around(const Points& landmarks, const Pose2& T_world_robot, double error_sd, std::size_t most,
                     std::mt19937_64& random) {
  std::normal_distribution<double> error(0.0, error_sd);
  Points points;
  for (const Eigen::Vector2d& p : landmarks) {
    const Eigen::Vector2d p_robot = inverse(T_world_robot) * p;
    if (p_robot.norm() <= reach)
      points.emplace_back(p_robot.x() + error(random), p_robot.y() + error(random));
  }
  std::ranges::sort(points, {}, [](const Eigen::Vector2d& p) { return p.norm(); });
  if (points.size() > most) points.resize(most);
  return points;
}

}  // namespace seif::test
