#include "harness/stress/stress_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "worlds/path.hpp"

namespace harness {

namespace {

constexpr double lane = 8.0;             // [m] distance between lanes
constexpr double sensor_range = 6.0;     // [m] above half the diagonal of a lane's square: all are seen
constexpr double clear_of_path = 0.7;    // [m] from the middle of the robot
constexpr double landmark_radius = 0.1;  // [m]
constexpr double margin = 10.0;          // [m] of ground around everything

// The ring: landmarks on two circles, inside and outside the robot's circle.
constexpr double ring_offset = 2.0;  // [m]
constexpr double ring_width = 6.0;   // [m] width of the band to which `density` refers
constexpr double ring_jitter = 0.5;  // [m]
constexpr double sagitta = 0.05;     // [m] largest distance of the driven polygon from its circle

/// The number of pairs of lanes for which the rectangle of all landmarks is nearly a square.
int pairs_of_lanes(const StressWorldSpec& spec) {
  const double side = std::sqrt(static_cast<double>(spec.landmarks) / spec.density);
  return std::max(1, static_cast<int>(std::lround(side / (2 * lane))));
}

/// Half the sides of the rectangle. The width is a whole number of lanes, so the distance of the lanes is the
/// same in all worlds. [m]
Eigen::Vector2d half_sides(const StressWorldSpec& spec) {
  const double width = 2 * lane * pairs_of_lanes(spec);
  return {0.5 * static_cast<double>(spec.landmarks) / spec.density / width, 0.5 * width};
}

double ring_radius(const StressWorldSpec& spec) {
  return static_cast<double>(spec.landmarks) / (spec.density * ring_width) / (2 * std::numbers::pi);
}

std::vector<Eigen::Vector2d> circle(double radius) {
  const int corners =
      std::max(16, static_cast<int>(std::ceil(std::numbers::pi / std::sqrt(2 * sagitta / radius))));
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

/// An even number of lanes, which start and end half a lane from the edge. The last lane ends on the side
/// where the first one starts.
std::vector<Eigen::Vector2d> lanes(const StressWorldSpec& spec) {
  const Eigen::Vector2d corner = (half_sides(spec).array() - 0.5 * lane).max(1.0);
  std::vector<Eigen::Vector2d> corners = worlds::serpentine(-corner, corner, lane);
  // Each pair of lanes has four corners; the corner with this index is the start of a lane on the side of the
  // way back.
  std::ranges::rotate(corners, corners.begin() + 4 * (pairs_of_lanes(spec) / 2));
  return corners;
}

std::string generators(const StressWorldSpec& spec) {
  const std::string common =
      fmt::format("radius_m: {}, clear_m: {{path: {}}}", landmark_radius, clear_of_path);
  if (spec.pattern == StressPattern::ring) {
    const std::int64_t inner = spec.landmarks / 2;
    const double radius = ring_radius(spec);
    const std::string ring = "    - {{type: ring, count: {}, ring_radius_m: {}, jitter_m: {}, {}}}\n";
    return fmt::format(fmt::runtime(ring), inner, radius - ring_offset, ring_jitter, common) +
           fmt::format(fmt::runtime(ring), spec.landmarks - inner, radius + ring_offset, ring_jitter, common);
  }
  const Eigen::Vector2d half = half_sides(spec);
  // The landmarks are spread evenly. By pure chance the path through one world would be denser than through
  // another.
  const double distance = 0.5 / std::sqrt(spec.density);
  return fmt::format(
      "    - {{type: poisson_disk, distance_m: {}, count: {}, region: {{min_m: [{}, {}], max_m: [{}, {}]}}, "
      "{}}}\n",
      distance, spec.landmarks, -half.x(), -half.y(), half.x(), half.y(), common);
}

std::string points(const std::vector<Eigen::Vector2d>& corners) {
  std::string text;
  for (const Eigen::Vector2d& corner : corners) {
    fmt::format_to(std::back_inserter(text), "{}[{}, {}]", text.empty() ? "" : ", ", corner.x(), corner.y());
  }
  return text;
}

}  // namespace

std::vector<Eigen::Vector2d> stress_round(const StressWorldSpec& spec) {
  return spec.pattern == StressPattern::ring ? circle(ring_radius(spec)) : lanes(spec);
}

std::string stress_world(const StressWorldSpec& spec) {
  const std::vector<Eigen::Vector2d> round = stress_round(spec);
  const Eigen::Vector2d way = round[1] - round[0];
  const double reach = ring_radius(spec) + ring_offset + ring_jitter;
  const Eigen::Vector2d half =
      spec.pattern == StressPattern::ring ? Eigen::Vector2d(reach, reach) : half_sides(spec);
  std::string estimators;
  for (const std::string& name : spec.estimators) estimators += fmt::format("  {}: {{}}\n", name);
  return fmt::format(
      "name: stress_{}\nseed: {}\nground: {{size_m: [{}, {}]}}\n"
      "robot: {{start: {{x_m: {}, y_m: {}, heading_deg: {}}}}}\n"
      "landmarks:\n  generators:\n{}"
      "drive: {{mode: loop, speed_m_s: 1.0, waypoints_m: [{}]}}\n"
      "sensors: {{landmark_sensor: {{max_range_m: {}}}}}\n"
      "estimators:{}\n{}",
      spec.landmarks, spec.seed, 2 * (half.x() + margin), 2 * (half.y() + margin), round[0].x(), round[0].y(),
      std::atan2(way.y(), way.x()) * 180 / std::numbers::pi, generators(spec), points(round), sensor_range,
      estimators.empty() ? " {}" : "", estimators);
}

}  // namespace harness
