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

}  // namespace

void check_faults(const Node& document, const World& world, std::vector<Problem>& problems) {
  if (!is_sound(problems, {"faults"})) return;
  const bool places_known = is_sound(problems, {"robot", "ground", "obstacles", "landmarks.placed"});
  const bool noise_known = is_sound(problems, {"sensors"});
  for (std::size_t i = 0; i < world.faults.size(); ++i) {
    const Fault& fault = world.faults[i];
    const std::string path = fmt::format("faults.{}", i);
    if (fault.kind == FaultKind::kidnapping && places_known) {
      const std::string blocked = what_blocks(fault.to.position, world);
      if (!blocked.empty())
        refuse_value(document, path, "the robot would be put where it has no room: " + blocked, problems);
    }
    const double off = std::abs(fault.size) * world.landmark_sensor.bearing_sd;
    if (fault.kind == FaultKind::outlier && noise_known && off >= 180 * degree)
      refuse_value(document, path + ".size_sigma",
                   fmt::format("so many standard deviations of {} deg are half a turn or more",
                               world.landmark_sensor.bearing_sd / degree),
                   problems);
  }
}

}  // namespace worlds
