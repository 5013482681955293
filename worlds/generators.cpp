#include "worlds/generators.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>

#include "worlds/geometry.hpp"
#include "worlds/limits.hpp"

namespace worlds {
namespace {

/// Draws one more candidate position for the landmark with this index.
using Candidate = std::function<Eigen::Vector2d(std::int64_t index)>;

/// Uniform in [low, high).
double draw(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Eigen::Vector2d draw_between(std::mt19937_64& random, const Eigen::Vector2d& min,
                             const Eigen::Vector2d& max) {
  const double x = draw(random, min.x(), max.x());
  return {x, draw(random, min.y(), max.y())};
}

Eigen::Vector2d jittered(const Eigen::Vector2d& p, double jitter, std::mt19937_64& random) {
  return jitter > 0
             ? p + draw_between(random, Eigen::Vector2d::Constant(-jitter), Eigen::Vector2d::Constant(jitter))
             : p;
}

/// Columns and rows of whole cells. The margin keeps rounding from giving a region of n cells only n - 1.
Eigen::Array2d grid_cells(const Generator& generator) {
  constexpr double margin = 1e-9;
  return ((generator.max - generator.min).cwiseQuotient(generator.cell).array() + margin).floor();
}

Candidate grid_candidate(const Generator& generator, std::mt19937_64& random) {
  const Eigen::Array2d cells = grid_cells(generator);
  const Eigen::Vector2d size = cells.matrix().cwiseProduct(generator.cell);
  const Eigen::Vector2d corner = 0.5 * (generator.min + generator.max - size);
  const auto columns = static_cast<std::int64_t>(cells.x());
  return [=, &generator, &random](std::int64_t index) {
    const std::int64_t column = index % columns;
    const std::int64_t row = index / columns;
    const Eigen::Array2d cell(static_cast<double>(column), static_cast<double>(row));
    return jittered(corner + (cell + 0.5).matrix().cwiseProduct(generator.cell), generator.jitter, random);
  };
}

Candidate ring_candidate(const Generator& generator, std::mt19937_64& random) {
  return [&](std::int64_t index) {
    const double turn = static_cast<double>(index) / static_cast<double>(generator.count);
    const double angle = 2 * std::numbers::pi * turn;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    return jittered(generator.centre + generator.ring_radius * direction, generator.jitter, random);
  };
}

Candidate cluster_candidate(const Generator& generator, std::mt19937_64& random) {
  std::vector<Eigen::Vector2d> centres;
  for (std::int64_t i = 0; i < generator.clusters; ++i) {
    centres.push_back(draw_between(random, generator.min, generator.max));
  }
  return [=, &generator, &random](std::int64_t index) {
    std::normal_distribution<double> normal(0.0, generator.cluster_sd);
    const double x = normal(random);
    const double y = normal(random);
    return Eigen::Vector2d(centres[static_cast<std::size_t>(index % generator.clusters)] +
                           Eigen::Vector2d(x, y));
  };
}

struct Line {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};

Line corridor_line(const Generator& generator, const World& world) {
  if (!generator.points.empty()) return {generator.points, generator.closed};
  return {world.drive.path, world.drive.closed};
}

/// The number of places on each side of the polyline: one at the centre of every `spacing`.
double corridor_places(const Generator& generator, const Line& line) {
  return std::floor(length(line.points, line.closed) / generator.spacing + 0.5);
}

/// Landmarks with even indices stand on the left of the polyline, those with odd indices on its right.
Candidate corridor_candidate(const Generator& generator, const World& world, std::mt19937_64& random) {
  const Line line = corridor_line(generator, world);
  const std::vector<Segment> segments = legs(line.points, line.closed);
  std::vector<Eigen::Vector2d> places;
  std::size_t leg = 0;
  double leg_start = 0.0;  // along the line
  const auto places_on_a_side = static_cast<std::int64_t>(corridor_places(generator, line));
  for (std::int64_t k = 0; k < places_on_a_side; ++k) {
    const double at = (static_cast<double>(k) + 0.5) * generator.spacing;
    double extent = (segments[leg].to - segments[leg].from).norm();
    for (; at > leg_start + extent && leg + 1 < segments.size(); ++leg) {
      leg_start += extent;
      extent = (segments[leg + 1].to - segments[leg + 1].from).norm();
    }
    const Eigen::Vector2d along = (segments[leg].to - segments[leg].from) / extent;
    const Eigen::Vector2d left(-along.y(), along.x());
    const Eigen::Vector2d foot = segments[leg].from + (at - leg_start) * along;
    places.push_back(foot + generator.offset * left);
    places.push_back(foot - generator.offset * left);
  }
  return [=, &generator, &random](std::int64_t index) {
    return jittered(places[static_cast<std::size_t>(index)], generator.jitter, random);
  };
}

Candidate make_candidate(const Generator& generator, const World& world, std::mt19937_64& random) {
  switch (generator.pattern) {
    case Pattern::uniform:
    case Pattern::poisson_disk:
      break;
    case Pattern::grid:
      return grid_candidate(generator, random);
    case Pattern::ring:
      return ring_candidate(generator, random);
    case Pattern::clusters:
      return cluster_candidate(generator, random);
    case Pattern::corridor:
      return corridor_candidate(generator, world, random);
  }
  return [&](std::int64_t) { return draw_between(random, generator.min, generator.max); };
}

bool in_region(const Generator& generator, const Eigen::Vector2d& p) {
  if (generator.pattern != Pattern::clusters) return true;  // only clusters can leave their region
  return (p.array() >= generator.min.array()).all() && (p.array() <= generator.max.array()).all();
}

bool has_fixed_places(const Generator& generator) {
  const Pattern pattern = generator.pattern;
  return pattern == Pattern::grid || pattern == Pattern::ring || pattern == Pattern::corridor;
}

}  // namespace

double wanted_landmarks(const Generator& generator, const World& world) {
  if (generator.pattern == Pattern::grid) return grid_cells(generator).prod();
  if (generator.pattern == Pattern::corridor) {
    return 2 * corridor_places(generator, corridor_line(generator, world));
  }
  if (generator.count > 0) return static_cast<double>(generator.count);
  return std::round(generator.density * (generator.max - generator.min).prod());
}

Placed generate(const Generator& generator, World& world, std::mt19937_64& random) {
  const Candidate candidate = make_candidate(generator, world, random);
  const double own_distance = generator.pattern == Pattern::poisson_disk ? generator.distance : 0.0;
  FreeSpace space(world, generator.radius, generator.clear, own_distance);
  const bool fixed = has_fixed_places(generator);
  const std::int64_t tries = fixed && generator.jitter == 0 ? 1 : generator.max_tries;
  Placed result{0, static_cast<std::int64_t>(wanted_landmarks(generator, world))};
  const std::int64_t most_tries = 4 * limits().fruitless_tries + 10 * result.wanted;  // [-] in all
  std::int64_t all_tries = 0;                                                         // [-]
  std::int64_t fruitless = 0;  // [-] tries since the last success
  for (std::int64_t i = 0, end = result.wanted; i < end; ++i) {
    bool placed = false;
    for (std::int64_t k = 0; k < tries && !placed; ++k) {
      const Eigen::Vector2d p = candidate(i);
      if (++fruitless > limits().fruitless_tries || ++all_tries > most_tries) return result;
      if (!in_region(generator, p) || !space.is_free(p)) continue;
      fruitless = 0;
      space.add(p);
      world.landmarks.push_back({p, generator.radius});
      ++result.placed;
      placed = true;
    }
    if (!placed && !fixed) return result;  // the remaining ones would find no place either
    if (!placed && generator.skip_blocked) --result.wanted;
  }
  return result;
}

std::mt19937_64 generator_stream(std::uint64_t seed, std::uint32_t index) {
  std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(seed),
                                      static_cast<std::uint32_t>(seed >> 32U)};
  for (const char letter : std::string_view("landmarks")) words.push_back(static_cast<std::uint32_t>(letter));
  words.push_back(index);
  std::seed_seq sequence(words.begin(), words.end());
  return std::mt19937_64(sequence);
}

}  // namespace worlds
