#include "worlds/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "worlds/check_faults.hpp"
#include "worlds/check_team.hpp"
#include "worlds/geometry.hpp"
#include "worlds/shape_tree.hpp"
#include "worlds/suggestion.hpp"

namespace worlds {
namespace {

/// Whether the two paths are equal, or one leads to the other.
bool on_one_path(std::string_view a, std::string_view b) {
  const std::string_view shorter = a.size() < b.size() ? a : b;
  const std::string_view longer = a.size() < b.size() ? b : a;
  return longer.starts_with(shorter) && (longer.size() == shorter.size() || longer[shorter.size()] == '.');
}

/// The paths in the document of the solid things of a world, in the order of solid_rectangles.
std::vector<std::string> names_of_solids(const World& world) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < world.boxes.size(); ++i) names.push_back(fmt::format("obstacles.boxes.{}", i));
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    const std::size_t count = legs(world.walls[i].points, world.walls[i].closed).size();
    names.insert(names.end(), count, fmt::format("obstacles.walls.{}", i));
  }
  return names;
}

/// The check of one robot's world, and the list that gets its problems.
struct Check {
  const Node& document;
  const World& world;
  std::vector<Problem>& problems;
  ShapeTree solids;
  std::vector<std::string> solid_names;
  std::string robot;  // path of a robot of a team; empty: the world's only one

  /// Where the document has this value of the robot.
  std::string place_of(std::string_view path) const {
    if (robot.empty()) return std::string(path);
    if (path == "robot.start") return robot + ".start";
    const std::string_view section = path.substr(0, path.find('.'));
    const Node* estimators = find_path(document, robot + ".estimators");
    const bool has_estimators = estimators != nullptr && !estimators->entries.empty();
    const bool is_own =
        section == "drive" || section == "sensors" || (section == "estimators" && has_estimators);
    return is_own ? fmt::format("{}.{}", robot, path) : std::string(path);
  }

  bool sound(const std::vector<std::string_view>& sections) const {
    return is_sound(problems, sections) && std::ranges::all_of(sections, [&](std::string_view section) {
             return is_sound(problems, {place_of(section)});
           });
  }

  void refuse(std::string_view path, std::string message) const {
    refuse_value(document, place_of(path), std::move(message), problems);
  }

  void refuse_landmark(std::size_t index, std::string message) const {
    refuse(fmt::format("landmarks.placed.{}", index), std::move(message));
  }
};

void check_range_noise(const Check& check) {
  const LandmarkSensor& sensor = check.world.landmark_sensor;
  const double sd = std::hypot(sensor.range_sd, sensor.range_sd_per_m * sensor.max_range);
  if (!check.sound({"sensors.landmark_sensor"}) || sd <= largest_range_sd) return;
  check.refuse("sensors.landmark_sensor",
               fmt::format("at max_range_m a range has a standard deviation of {:.4g} m; the largest allowed "
                           "is {:g} m",
                           sd, largest_range_sd));
}

void check_rates(const Check& check) {
  const int step_rate = check.world.physics.step_rate;
  const auto check_rate = [&](std::string_view path, int rate) {
    if (!check.sound({path, "physics.step_rate_hz"}) || step_rate % rate == 0) return;
    check.refuse(path,
                 fmt::format("the rate must divide physics.step_rate_hz, which is {} Hz; {} Hz does not",
                             step_rate, rate));
  };
  check_rate("sensors.encoders.rate_hz", check.world.encoders.rate);
  check_rate("sensors.landmark_sensor.rate_hz", check.world.landmark_sensor.rate);
}

/// Refuses settings that have no effect in the kinematic engine.
void check_engine(const Check& check) {
  const Physics& physics = check.world.physics;
  if (!check.sound({"physics.engine"}) || physics.engine != Engine::kinematic) return;
  const auto refuse_if_any = [&](std::string_view path, bool any) {
    if (!any || !check.sound({path})) return;
    check.refuse(path, fmt::format("the kinematic engine knows no {}: take them out, or set physics.engine "
                                   "to bullet",
                                   path.substr(path.rfind('.') + 1)));
  };
  refuse_if_any("obstacles.boxes", !check.world.boxes.empty());
  refuse_if_any("obstacles.walls", !check.world.walls.empty());
  refuse_if_any("physics.patches", !physics.patches.empty());
}

void check_pose_source(const Check& check) {
  if (!check.sound({"drive.pose_from", "estimators"})) return;
  std::vector<std::string> names = {"truth", "odometry"};
  for (const EstimatorChoice& choice : check.world.estimators) names.push_back(choice.name);
  const std::string& name = check.world.drive.pose_from;
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  check.refuse("drive.pose_from",
               fmt::format("'pose_from' must be truth, odometry or one of the estimators, not '{}'{}", name,
                           suggestion(name, names)));
}

/// The estimators that are filmed must run.
void check_film(const Check& check) {
  if (!check.sound({"film.estimators", "estimators"})) return;
  std::vector<std::string> names;
  for (const EstimatorChoice& choice : check.world.estimators) names.push_back(choice.name);
  const std::vector<std::string>& filmed = check.world.film.estimators;
  for (std::size_t i = 0; i < filmed.size(); ++i) {
    if (std::find(names.begin(), names.end(), filmed[i]) != names.end()) continue;
    check.refuse(fmt::format("film.estimators.{}", i), fmt::format("there is no estimator '{}' to film{}",
                                                                   filmed[i], suggestion(filmed[i], names)));
  }
}

void check_speed(const Check& check) {
  const Drive& drive = check.world.drive;
  const bool cruises = drive.mode != DriveMode::hold && drive.mode != DriveMode::commands;
  if (!cruises || !check.sound({"drive", "robot"}) || drive.speed <= check.world.robot.max_speed) return;
  check.refuse("drive.speed_m_s", fmt::format("the speed is more than robot.max_speed_m_s, which is {} m/s",
                                              check.world.robot.max_speed));
}

void check_start(const Check& check) {
  if (!check.sound({"robot", "robot.start", "ground", "obstacles"})) return;
  const Eigen::Vector2d& start = check.world.robot.start.position;
  const double radius = footprint_radius(check.world.robot);
  if (!on_ground(start, radius, check.world.ground_size)) {
    check.refuse(
        "robot.start",
        fmt::format("the robot, which reaches {:.3f} m around its axle, starts off the ground", radius));
  }
  check.solids.any_near(start, radius, [&](std::size_t i, const Rectangle& solid) {
    if (distance(start, solid) >= radius) return false;
    check.refuse("robot.start",
                 fmt::format("the robot, which reaches {:.3f} m around its axle, starts inside of {}", radius,
                             check.solid_names[i]));
    return true;
  });
}

/// Checks the corners of the path first, then its legs. A leg is only reported if both of its ends are good.
void check_path(const Check& check) {
  const Drive& drive = check.world.drive;
  if (drive.path.empty() || !check.sound({"drive", "robot", "ground", "obstacles"})) return;
  const bool has_corners = drive.mode != DriveMode::serpentine;
  const double half_width = 0.5 * check.world.robot.track;
  for (std::size_t i = 0; i < drive.path.size(); ++i) {
    const Eigen::Vector2d& p = drive.path[i];
    const std::string path = has_corners ? fmt::format("drive.waypoints_m.{}", i) : "drive";
    const std::string corner = fmt::format("the path's corner [{}, {}]", p.x(), p.y());
    if (!on_ground(p, half_width, check.world.ground_size)) {
      check.refuse(path, corner + " is off the ground, or too close to its edge for the robot");
    }
    check.solids.any_near(p, half_width, [&](std::size_t k, const Rectangle& solid) {
      if (distance(p, solid) >= half_width) return false;
      check.refuse(path, fmt::format("{} is inside of {}, or too close to it for the robot", corner,
                                     check.solid_names[k]));
      return true;
    });
  }
  if (!check.sound({"drive"})) return;
  const std::vector<Segment> path_legs = legs(drive.path, drive.closed);
  for (std::size_t i = 0; i < path_legs.size(); ++i) {
    const Segment& leg = path_legs[i];
    check.solids.any_near(leg, half_width, [&](std::size_t k, const Rectangle& solid) {
      if (distance(leg, solid) >= half_width) return false;
      check.refuse(has_corners ? fmt::format("drive.waypoints_m.{}", i) : "drive",
                   fmt::format("the path from [{}, {}] to [{}, {}] meets {}", leg.from.x(), leg.from.y(),
                               leg.to.x(), leg.to.y(), check.solid_names[k]));
      return true;
    });
  }
}

void check_landmarks_alone(const Check& check) {
  const std::vector<Landmark>& landmarks = check.world.landmarks;
  std::vector<Rectangle> shapes;  // squares around the landmarks
  for (const Landmark& landmark : landmarks)
    shapes.push_back(
        {landmark.position, Eigen::Vector2d::UnitX(), Eigen::Vector2d::Constant(landmark.radius)});
  const ShapeTree tree(std::move(shapes));
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Landmark& landmark = landmarks[i];
    if (!on_ground(landmark.position, landmark.radius, check.world.ground_size)) {
      check.refuse_landmark(i, "the landmark is not wholly on the ground");
    }
    tree.any_near(landmark.position, landmark.radius, [&](std::size_t other, const Rectangle& shape) {
      const double apart = (landmark.position - shape.centre).norm();
      if (other >= i || apart >= landmark.radius + landmarks[other].radius) return false;
      check.refuse_landmark(i, fmt::format("the landmark overlaps landmarks.placed.{}", other));
      return true;
    });
  }
}

void check_landmarks_in_obstacles(const Check& check) {
  const std::vector<Landmark>& landmarks = check.world.landmarks;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Landmark& landmark = landmarks[i];
    check.solids.any_near(landmark.position, landmark.radius, [&](std::size_t solid, const Rectangle& shape) {
      if (distance(landmark.position, shape) >= landmark.radius) return false;
      check.refuse_landmark(i, fmt::format("the landmark is inside of {}", check.solid_names[solid]));
      return true;
    });
  }
}

void check_landmarks_at_start(const Check& check) {
  const std::vector<Landmark>& landmarks = check.world.landmarks;
  const double reach = footprint_radius(check.world.robot);
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const double apart = (landmarks[i].position - check.world.robot.start.position).norm();
    if (apart >= reach + landmarks[i].radius) continue;
    check.refuse_landmark(
        i,
        fmt::format("the landmark is where the robot starts, which reaches {:.3f} m around its axle", reach));
  }
}

void check_landmarks_on_path(const Check& check) {
  const std::vector<Landmark>& landmarks = check.world.landmarks;
  const double half_width = 0.5 * check.world.robot.track;
  std::vector<Rectangle> path_legs;
  for (const Segment& leg : legs(check.world.drive.path, check.world.drive.closed))
    path_legs.push_back(rectangle(leg, 0.0));
  const ShapeTree path(std::move(path_legs));
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Landmark& landmark = landmarks[i];
    const double reach = landmark.radius + half_width;
    const bool on_path = path.any_near(landmark.position, reach, [&](std::size_t, const Rectangle& leg) {
      return distance(landmark.position, leg) < reach;
    });
    if (on_path)
      check.refuse_landmark(i, "the landmark stands in the way: the robot's path leads through it");
  }
}

/// Those placed by hand, against each other and against what blocks motion.
void check_landmarks(const Check& check) {
  if (check.world.landmarks.empty() || !check.sound({"landmarks.placed", "ground"})) return;
  const bool obstacles_known = check.sound({"obstacles"});
  check_landmarks_alone(check);
  if (obstacles_known) check_landmarks_in_obstacles(check);
}

/// The same, against a robot.
void check_landmarks_in_way(const Check& check) {
  if (check.world.landmarks.empty() || !check.sound({"landmarks.placed", "ground", "robot", "robot.start"}))
    return;
  const bool path_known = check.sound({"drive"});
  check_landmarks_at_start(check);
  if (path_known) check_landmarks_on_path(check);
}

/// What a robot has of its own.
void check_member(const Check& check) {
  check_rates(check);
  check_range_noise(check);
  check_pose_source(check);
  check_speed(check);
  check_start(check);
  check_path(check);
}

}  // namespace

bool is_sound(const std::vector<Problem>& problems, const std::vector<std::string_view>& sections) {
  return std::none_of(problems.begin(), problems.end(), [&](const Problem& problem) {
    return std::any_of(sections.begin(), sections.end(),
                       [&](std::string_view section) { return on_one_path(problem.path, section); });
  });
}

void refuse_value(const Node& document, std::string_view path, std::string message,
                  std::vector<Problem>& problems) {
  const Node* node = nullptr;
  for (std::string_view at = path; node == nullptr;) {
    node = find_path(document, at);
    const std::size_t dot = at.rfind('.');
    at = dot == std::string_view::npos ? std::string_view() : at.substr(0, dot);
  }
  problems.push_back({node->where, std::move(message), std::string(path)});
}

void check_film(const Node& document, const World& world, std::vector<Problem>& problems) {
  check_film(Check{document, world, problems, ShapeTree({}), {}, {}});
}

void check_world(const Node& document, const World& world, std::vector<Problem>& problems) {
  if (is_sound(problems, {"robots"})) check_team(document, world, problems);
  const bool obstacles_known = is_sound(problems, {"obstacles"});
  const auto check_of = [&](const World& of, std::string robot) {
    return Check{document,
                 of,
                 problems,
                 ShapeTree(obstacles_known ? solid_rectangles(of) : std::vector<Rectangle>{}),
                 obstacles_known ? names_of_solids(of) : std::vector<std::string>{},
                 std::move(robot)};
  };
  const std::vector<World> alone = worlds_of_robots(world);
  std::vector<Check> robots;
  for (std::size_t i = 0; i < alone.size(); ++i)
    robots.push_back(check_of(alone[i], world.robots.empty() ? "" : fmt::format("robots.{}", i)));
  const Check whole = check_of(world, "");
  std::ranges::for_each(robots, check_member);
  check_landmarks(whole);
  std::ranges::for_each(robots, check_landmarks_in_way);
  check_engine(whole);
  check_faults(document, world, problems);
  check_film(whole);
}

}  // namespace worlds
