// Generators: they place landmarks by a rule and at random.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "worlds/free_space.hpp"
#include "worlds/world.hpp"

namespace worlds {

enum class Pattern {
  uniform,       // anywhere in the region
  poisson_disk,  // anywhere in the region, at least `distance` between centres (dart throwing; Cook 1986)
  grid,          // at the centre of each cell of a grid over the region
  ring,          // evenly around a circle
  clusters,      // normally distributed around random points in the region
  corridor,      // on both sides along a polyline
};

/// What to place, and how. The pattern decides which values are used.
struct Generator {
  Pattern pattern = Pattern::uniform;
  double radius = 0.1;  // [m] of each landmark
  Clearances clear;
  std::int64_t max_tries = 1000;                     // [-] for each landmark
  std::int64_t count = 0;                            // [-] landmarks; 0: `density` decides
  double density = 0.0;                              // [1/m^2] landmarks in the region; 0: `count` decides
  Eigen::Vector2d min = Eigen::Vector2d::Zero();     // [m] of the region
  Eigen::Vector2d max = Eigen::Vector2d::Zero();     // [m] of the region
  double distance = 1.0;                             // [m] poisson_disk: between centres
  Eigen::Vector2d cell = Eigen::Vector2d::Ones();    // [m] grid: size of a cell
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // [m] ring
  double ring_radius = 5.0;                          // [m] ring
  std::int64_t clusters = 5;                         // [-] clusters: how many
  double cluster_sd = 2.0;                           // [m] clusters: of the normal distribution
  std::vector<Eigen::Vector2d> points;               // [m] corridor: the polyline; empty: the drive's path
  bool closed = false;                               // corridor: whether the polyline is closed
  double offset = 1.5;                               // [m] corridor: from the line to the centres
  double spacing = 2.0;                              // [m] corridor: along the line
  double jitter = 0.0;  // [m] grid, ring, corridor: largest random offset, in x and in y
  /// grid, ring, corridor: landmarks without a free place are left out; false: failure
  bool skip_blocked = false;
};

/// How many landmarks were placed, and how many were wanted. Landmarks that `skip_blocked` has left out are not
/// counted as wanted.
struct Placed {
  std::int64_t placed = 0;
  std::int64_t wanted = 0;
};

/// The number of landmarks that the generator is to place.
double wanted_landmarks(const Generator& generator, const World& world);

/// Adds landmarks at the end of world.landmarks, clear of everything in the world. Each landmark gets at most
/// max_tries tries. The call ends early (placed < wanted) when a random landmark finds no place, or when the
/// number of tries in a row without success reaches that of limits().
Placed generate(const Generator& generator, World& world, std::mt19937_64& random);

/// The random stream of the generator with this index in the file: std::seed_seq over the two halves of the
/// seed, the letters of "landmarks" and the index. So a change to one generator does not change the random
/// numbers of the others.
std::mt19937_64 generator_stream(std::uint64_t seed, std::uint32_t index);

}  // namespace worlds
