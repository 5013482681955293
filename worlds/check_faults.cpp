#include "worlds/check_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "worlds/check.hpp"
#include "worlds/geometry.hpp"

namespace worlds {
namespace {

/// Why the robot cannot be put at p; empty if it can.
std::string what_blocks(const Eigen::Vector2d& p, const World& world) {
  const double reach = footprint_radius(world.robot);
  if (!on_ground(p, reach, world.ground_size)) return "off the ground";
  const std::vector<Rectangle> solids = solid_rectangles(world);
  if (std::ranges::any_of(solids, [&](const Rectangle& solid) { return distance(p, solid) < reach; }))
    return "inside of a box or wall";
  const bool in_landmark = std::ranges::any_of(world.landmarks, [&](const Landmark& landmark) {
    return (landmark.position - p).norm() < reach + landmark.radius;
  });
  return in_landmark ? "inside of a landmark" : "";
}

/// Of the sensors to which the fault happens. [rad]
double largest_bearing_sd(const Fault& fault, const World& world) {
  if (world.robots.empty()) return world.landmark_sensor.bearing_sd;
  double largest = 0.0;
  for (const TeamRobot& robot : world.robots) {
    if (fault.robot.empty() || fault.robot == robot.name)
      largest = std::max(largest, robot.landmark_sensor.bearing_sd);
  }
  return largest;
}

}  // namespace

std::string why_it_cannot_appear(const Fault& fault, const World& world) {
  const bool is_kinematic = world.physics.engine == Engine::kinematic;
  if (is_kinematic && (fault.kind == FaultKind::ice || fault.kind == FaultKind::wall))
    return fmt::format("the kinematic engine knows no {}; physics.engine: bullet does",
                       fault.kind == FaultKind::ice ? "friction" : "walls");
  if (fault.kind == FaultKind::wall && std::ranges::any_of(fault.wall.points, [&](const Eigen::Vector2d& p) {
        return !on_ground(p, 0.0, world.ground_size);
      }))
    return "the wall would stand off the ground";
  if (fault.kind != FaultKind::landmark) return "";
  if (world.landmark_sensor.false_detections > 0.0 || world.landmark_sensor.misread_probability > 0.0)
    return "no landmark can appear where the sensor has false detections or misreads ids: theirs are the "
           "next ids";
  return on_ground(fault.landmark.position, 0.0, world.ground_size)
             ? ""
             : "the landmark would stand off the ground";
}

std::string why_it_has_no_room(const Placement& robot, const World& world) {
  const std::string blocked = what_blocks(robot.position, world);
  return blocked.empty() ? "" : "the robot would be put where it has no room: " + blocked;
}

void check_faults(const Node& document, const World& world, std::vector<Problem>& problems) {
  if (!is_sound(problems, {"faults"})) return;
  const bool places_known =
      is_sound(problems, {"robot", "ground", "physics", "obstacles", "landmarks.placed"});
  const bool noise_known = is_sound(problems, {"sensors", "robots"});
  for (std::size_t i = 0; i < world.faults.size(); ++i) {
    const Fault& fault = world.faults[i];
    const std::string path = fmt::format("faults.{}", i);
    if (fault.kind == FaultKind::kidnapping && places_known) {
      const std::string why = why_it_has_no_room(fault.to, world);
      if (!why.empty()) refuse_value(document, path, why, problems);
    }
    if (places_known && noise_known) {
      const std::string why = why_it_cannot_appear(fault, world);
      if (!why.empty()) refuse_value(document, path, why, problems);
    }
    const double bearing_sd = largest_bearing_sd(fault, world);
    if (fault.kind == FaultKind::outlier && noise_known && std::abs(fault.size) * bearing_sd >= 180 * degree)
      refuse_value(
          document, path + ".size_sigma",
          fmt::format("so many standard deviations of {} deg are half a turn or more", bearing_sd / degree),
          problems);
  }
}

}  // namespace worlds
