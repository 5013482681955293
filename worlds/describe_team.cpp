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

constexpr double longest_range = 1e6;  // [m]
constexpr double longest_delay = 1e3;  // [s]
constexpr double least_rate = 1.0;     // [byte/s]
constexpr double highest_rate = 1e12;  // [byte/s]

void describe_radio(Fields& fields, Radio& radio) {
  fields.number("range_m", radio.range, between(0, longest_range),
                "how far it reaches; 0: nobody hears anybody");
  fields.number("loss", radio.loss, between(0, 1), "probability that a packet does not come");
  fields.number("cut_off", radio.cut_off, between(0, 1), "probability that only the begin of a packet comes");
  fields.number("delay_s", radio.delay, between(0, longest_delay), "time until a packet comes");
  fields.number("rate_bytes_s", radio.rate, between(least_rate, highest_rate),
                "bytes a second that one robot sends");
}

}  // namespace

void describe_team(Fields& fields, WorldFile& file, const EstimatorSchemas& estimators) {
  fields.list(
      "robots", file.robots,
      [&](Fields& item, TeamRobotFile& member) { describe_member(item, member, file.world, estimators); },
      "several robots in one world, each with a drive and estimators of its own; none: the one above");
  fields.section("radio",
                 "how the robots of a team exchange what they know; each packet goes to all in range",
                 [&](Fields& inner) { describe_radio(inner, file.world.radio); });
}

}  // namespace worlds
