#include "worlds/check_team.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "worlds/check.hpp"
#include "worlds/geometry.hpp"
#include "worlds/suggestion.hpp"

namespace worlds {
namespace {

/// A robot of a team has its own start and drive. Those of the lone robot would do nothing.
void check_lone_robot(const Node& document, const World& world, std::vector<Problem>& problems) {
  const Placement& start = world.robot.start;
  if (start.position != Eigen::Vector2d::Zero() || start.heading != 0.0)
    refuse_value(document, "robot.start",
                 "the world has 'robots', and each has its own 'start': move this one there", problems);
  if (world.drive.mode != DriveMode::hold || !world.drive.takeover_file.empty())
    refuse_value(document, "drive",
                 "the world has 'robots', and each has its own 'drive': move this one there", problems);
}

void check_names_and_starts(const Node& document, const World& world, std::vector<Problem>& problems) {
  const double least = 2.0 * footprint_radius(world.robot);
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const TeamRobot& robot = world.robots[i];
    for (std::size_t j = 0; j < i; ++j) {
      const TeamRobot& other = world.robots[j];
      if (robot.name == other.name)
        refuse_value(document, fmt::format("robots.{}.name", i),
                     fmt::format("two robots have the name '{}'", robot.name), problems);
      const double apart = (robot.start.position - other.start.position).norm();
      if (apart < least)
        refuse_value(
            document, fmt::format("robots.{}.start", i),
            fmt::format("the robot starts {:.3f} m from '{}'; robots reach {:.3f} m around their axles",
                        apart, other.name, 0.5 * least),
            problems);
    }
  }
}

/// Why this cannot happen in a team; empty if it can.
std::string why_not_in_team(const Fault& fault) {
  switch (fault.kind) {
    case FaultKind::kidnapping:
      return fault.robot.empty()
                 ? "in a team, a kidnapping needs 'robot': the name of the robot that is moved"
                 : "";
    case FaultKind::ice:
    case FaultKind::wall:
    case FaultKind::landmark:
      return "nothing can appear in a world of several robots";
    case FaultKind::bad_observation:
    case FaultKind::outlier:
    case FaultKind::encoder_jump:
    case FaultKind::silence:
    case FaultKind::option:
      break;
  }
  return "";
}

void check_faults_of_team(const Node& document, const World& world, std::vector<Problem>& problems) {
  std::vector<std::string> names;
  for (const TeamRobot& robot : world.robots) names.push_back(robot.name);
  for (std::size_t i = 0; i < world.faults.size(); ++i) {
    const Fault& fault = world.faults[i];
    const std::string path = fmt::format("faults.{}", i);
    if (!fault.robot.empty() && std::ranges::find(names, fault.robot) == names.end())
      refuse_value(
          document, path + ".robot",
          fmt::format("there is no robot '{}' among 'robots'{}", fault.robot, suggestion(fault.robot, names)),
          problems);
    if (world.robots.empty()) continue;
    if (const std::string why = why_not_in_team(fault); !why.empty())
      refuse_value(document, path, why, problems);
  }
}

}  // namespace

void check_team(const Node& document, const World& world, std::vector<Problem>& problems) {
  if (is_sound(problems, {"faults"})) check_faults_of_team(document, world, problems);
  if (world.robots.empty()) {
    if (!(world.radio == Radio{}))
      refuse_value(document, "radio",
                   "the world has one robot, and nobody to hear it: 'radio' is for 'robots'", problems);
    return;
  }
  if (world.robots.size() == 1)
    refuse_value(document, "robots",
                 "a team has two robots or more; a lone robot is described by 'robot' and 'drive'", problems);
  check_lone_robot(document, world, problems);
  if (is_sound(problems, {"robot"})) check_names_and_starts(document, world, problems);
}

}  // namespace worlds
