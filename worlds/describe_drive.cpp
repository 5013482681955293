#include "worlds/describe_drive.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "worlds/describe_parts.hpp"
#include "worlds/geometry.hpp"

namespace worlds {
namespace {

constexpr std::array<std::string_view, 6> mode_names = {"hold",       "waypoints", "loop",
                                                        "serpentine", "explore",   "commands"};

void describe_pursuit(Fields& fields, Drive& drive) {
  fields.number("speed_m_s", drive.speed, more_than_up_to(0, highest_speed), "cruising speed");
  fields.number("lookahead_m", drive.lookahead, between(0.001, largest_clearance),
                "lookahead distance of the pure pursuit");
}

void describe_waypoints(Fields& fields, Drive& drive, bool closed) {
  const std::size_t min_count = closed ? 3 : 1;
  describe_pursuit(fields, drive);
  fields.points("waypoints_m", drive.path, coordinate(), min_count, "corners of the path", Need::required);
  const std::size_t expected = drive.path.size() - (closed ? 0 : 1);
  if (fields.sound() && drive.path.size() > 1 && legs(drive.path, closed).size() != expected) {
    fields.problem("waypoints_m", closed ? "two waypoints in a row are equal (a loop returns by itself)"
                                         : "two waypoints in a row are equal");
  }
}

void describe_serpentine(Fields& fields, Drive& drive, SerpentineArea& area) {
  constexpr double most_lanes = 1e4;
  describe_pursuit(fields, drive);
  fields.vector2("min_m", area.min, coordinate(), "lower left corner of the area", Need::required);
  fields.vector2("max_m", area.max, coordinate(), "upper right corner of the area", Need::required);
  fields.number("lane_m", area.lane, more_than_up_to(0, largest_ground), "at most, from lane to lane");
  fields.boolean("closed", drive.closed, "whether the robot drives back to the first lane and begins again");
  check_corners(fields, area.min, area.max);
  if (fields.sound() && area.max.y() - area.min.y() > most_lanes * area.lane) {
    fields.problem("lane_m", fmt::format("these are more than {} lanes", most_lanes));
  }
}

std::vector<Fields::Case> drive_cases(Drive& drive, SerpentineArea& area) {
  return {
      {"hold", "stand still", [](Fields&) {}},
      {"waypoints", "follow a path to its end",
       [&](Fields& fields) { describe_waypoints(fields, drive, false); }},
      {"loop", "follow a closed path round and round",
       [&](Fields& fields) { describe_waypoints(fields, drive, true); }},
      {"serpentine", "cover a rectangle in lanes",
       [&](Fields& fields) { describe_serpentine(fields, drive, area); }},
      {"explore", "drive at random, clear of everything",
       [&](Fields& fields) {
         describe_pursuit(fields, drive);
         fields.number("clearance_m", drive.clearance, more_than_up_to(0, largest_clearance),
                       "least distance from the robot's centre to anything solid");
       }},
      {"commands", "recorded velocities",
       [&](Fields& fields) {
         fields.text("file", drive.commands_file,
                     "CSV with the head t,v,omega [s, m/s, rad/s]; a path relative to the world file",
                     Need::required);
       }},
  };
}

}  // namespace

void describe_drive(Fields& fields, Drive& drive, SerpentineArea& area) {
  std::string mode = name_of(mode_names, drive.mode);
  fields.variant("mode", mode, drive_cases(drive, area), "what the robot does");
  drive.mode = enum_of<DriveMode>(mode_names, mode);
  drive.closed = drive.closed || drive.mode == DriveMode::loop;
  fields.text("pose_from", drive.pose_from,
              "whose pose steers: truth, odometry, or the name of an estimator");
  fields.text("takeover_file", drive.takeover_file,
              "CSV file t,v,omega: from time t on, this command moves the robot and not the drive; a row "
              "without v and "
              "omega gives the wheel back to the drive",
              Need::optional);
}

}  // namespace worlds
