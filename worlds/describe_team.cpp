#include "worlds/describe_team.hpp"

#include <fmt/format.h>

#include "worlds/describe_estimators.hpp"
#include "worlds/describe_parts.hpp"
#include "worlds/describe_sensors.hpp"
#include "worlds/names.hpp"

namespace worlds {
namespace {

void describe_member(Fields& fields, TeamRobotFile& member, const World& world,
                     const EstimatorSchemas& estimators) {
  TeamRobot& robot = member.robot;
  robot.encoders = world.encoders;
  robot.landmark_sensor = world.landmark_sensor;
  robot.start_estimate = world.start_estimate;
  fields.text("name", robot.name, "its name, and that of its folder", Need::required);
  if (fields.sound() && !is_name(robot.name))
    fields.problem("name", fmt::format("'{}' is no name: use {}", robot.name, name_alphabet()));
  fields.section("start", "where the middle of its axle is at the start",
                 [&](Fields& inner) { describe_placement(inner, robot.start, Need::required); });
  fields.section("drive", "what it is told to do",
                 [&](Fields& inner) { describe_drive(inner, robot.drive, member.area); });
  fields.section("sensors", "what it measures with; by default the world's sensors",
                 [&](Fields& inner) { describe_sensors(inner, robot.encoders, robot.landmark_sensor); });
  fields.section("start_estimate", "as for the world, whose values are the defaults",
                 [&](Fields& inner) { describe_start_estimate(inner, robot.start_estimate); });
  describe_estimators(fields, robot.estimators, estimators, "its estimators; none: those of the world");
}

}  // namespace

void describe_team(Fields& fields, WorldFile& file, const EstimatorSchemas& estimators) {
  fields.list(
      "robots", file.robots,
      [&](Fields& item, TeamRobotFile& member) { describe_member(item, member, file.world, estimators); },
      "several robots in one world, each with a drive and estimators of its own; none: the one above");
}

}  // namespace worlds
