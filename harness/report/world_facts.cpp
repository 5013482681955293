#include "harness/report/world_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/statistics/degrees.hpp"
#include "worlds/geometry.hpp"
#include "worlds/load.hpp"

namespace harness {

namespace {

/// At most six digits: more are only rounding.
std::string short_number(double value) { return fmt::format("{:.6g}", value); }

std::string in_degrees(double angle) { return short_number(degrees_per_radian * angle) + " deg"; }

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string joined_by(const std::vector<std::string>& parts, std::string_view between) {
  return fmt::format("{}", fmt::join(parts, between));
}

std::string engine_text(const worlds::Physics& physics) {
  if (physics.engine == worlds::Engine::kinematic) return "kinematic: exact arcs, without contacts and slip";
  return fmt::format("Bullet: contacts, friction and slip, {} steps a second", physics.step_rate);
}

std::string landmarks_text(const worlds::World& world) {
  if (world.landmarks.empty()) return "none";
  const auto [least, most] = std::ranges::minmax_element(world.landmarks, {}, &worlds::Landmark::radius);
  const std::string radius = least->radius == most->radius
                                 ? short_number(least->radius)
                                 : short_number(least->radius) + " to " + short_number(most->radius);
  return fmt::format("{}, radius {} m", world.landmarks.size(), radius);
}

std::string obstacles_text(const worlds::World& world) {
  std::vector<std::string> parts;
  double length = 0.0;
  for (const worlds::Wall& wall : world.walls) length += worlds::length(wall.points, wall.closed);
  if (!world.walls.empty())
    parts.push_back(fmt::format("{}, {:.1f} m in all", counted(world.walls.size(), "wall", "walls"), length));
  if (!world.boxes.empty()) parts.push_back(counted(world.boxes.size(), "box", "boxes"));
  return parts.empty() ? "none" : joined_by(parts, "; ");
}

std::string friction_text(const worlds::Physics& physics) {
  std::string text = short_number(physics.friction);
  for (const worlds::FrictionPatch& patch : physics.patches)
    text +=
        fmt::format("; {} on a patch of {} x {} m", short_number(patch.friction),
                    short_number(patch.max.x() - patch.min.x()), short_number(patch.max.y() - patch.min.y()));
  return text;
}

std::string way_text(const worlds::Drive& drive) {
  const std::string path =
      fmt::format("{} points, {:.1f} m", drive.path.size(), worlds::length(drive.path, drive.closed));
  switch (drive.mode) {
    case worlds::DriveMode::hold:
      return "the robot stands still";
    case worlds::DriveMode::waypoints:
      return "along waypoints: " + path;
    case worlds::DriveMode::loop:
      return "round a loop again and again: " + path;
    case worlds::DriveMode::serpentine:
      return "along a serpentine: " + path;
    case worlds::DriveMode::explore:
      return fmt::format("explores by itself, {} m clear of anything solid", short_number(drive.clearance));
    case worlds::DriveMode::commands:
      return fmt::format("by {} velocity commands from a file", drive.commands.size());
  }
  return {};
}

std::string drive_text(const worlds::Drive& drive) {
  if (drive.mode == worlds::DriveMode::hold || drive.mode == worlds::DriveMode::commands)
    return way_text(drive);
  return fmt::format("{}; {} m/s; steered by {}", way_text(drive), short_number(drive.speed),
                     drive.pose_from == "truth" ? "the truth" : drive.pose_from);
}

std::string encoders_text(const worlds::Encoders& encoders) {
  std::vector<std::string> parts = {fmt::format("{} readings a second", encoders.rate)};
  parts.push_back(encoders.ticks_per_revolution == 0
                      ? "no quantisation"
                      : fmt::format("{} ticks for each turn of a wheel", encoders.ticks_per_revolution));
  parts.push_back(
      fmt::format("random error of a wheel {} m after 1 m rolled", short_number(encoders.distance_sd)));
  if (encoders.calibrated) return joined_by(parts, ", ") + ", calibrated";
  if (encoders.diameter_ratio != 1.0 || encoders.diameter_ratio_sd != 0.0)
    parts.push_back(fmt::format("right over left diameter {} +- {}", short_number(encoders.diameter_ratio),
                                short_number(encoders.diameter_ratio_sd)));
  if (encoders.track_ratio != 1.0 || encoders.track_ratio_sd != 0.0)
    parts.push_back(fmt::format("true over assumed track {} +- {}", short_number(encoders.track_ratio),
                                short_number(encoders.track_ratio_sd)));
  return joined_by(parts, ", ");
}

std::string noise_text(double range_sd, double range_sd_per_m, double bearing_sd) {
  const std::string growing =
      range_sd_per_m > 0.0 ? fmt::format(" and {} % of the range", short_number(100.0 * range_sd_per_m)) : "";
  return fmt::format("{} m{} in range, {} in bearing", short_number(range_sd), growing,
                     in_degrees(bearing_sd));
}

std::string mistakes_text(const worlds::LandmarkSensor& sensor) {
  std::vector<std::string> parts;
  if (sensor.miss_probability > 0.0)
    parts.push_back(
        fmt::format("misses {} % of what it could see", short_number(100 * sensor.miss_probability)));
  if (sensor.false_detections > 0.0)
    parts.push_back(fmt::format("{} false detections in a scan", short_number(sensor.false_detections)));
  if (sensor.misread_probability > 0.0)
    parts.push_back(fmt::format("misreads {} % of the ids", short_number(100 * sensor.misread_probability)));
  return joined_by(parts, ", ");
}

std::string_view name_of(worlds::FaultKind kind) {
  switch (kind) {
    case worlds::FaultKind::bad_observation:
      return "bad observation";
    case worlds::FaultKind::outlier:
      return "outlier";
    case worlds::FaultKind::encoder_jump:
      return "encoder jump";
    case worlds::FaultKind::silence:
      return "silence";
    case worlds::FaultKind::kidnapping:
      return "kidnapping";
    case worlds::FaultKind::ice:
      return "ice";
    case worlds::FaultKind::wall:
      return "a wall";
    case worlds::FaultKind::landmark:
      return "a landmark";
    case worlds::FaultKind::option:
      break;
  }
  return "another option";
}

std::string fault_text(const worlds::Fault& fault) {
  const std::string whose =
      fault.kind == worlds::FaultKind::option
          ? fmt::format(" ({}: {} = {})", fault.estimator, fault.option, short_number(fault.option_value))
          : "";
  return fmt::format("{}{} at {} s", name_of(fault.kind), whose, short_number(fault.at));
}

std::string option_text(const worlds::OptionValue& value) {
  return std::visit(
      [](const auto& one) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(one)>, double>) return short_number(one);
        return fmt::format("{}", one);
      },
      value);
}

std::string choice_text(const worlds::EstimatorChoice& choice) {
  std::vector<std::string> parts;
  if (choice.type != choice.name) parts.push_back("type " + choice.type);
  if (choice.odometry_sd_factor != 1.0)
    parts.push_back(
        fmt::format("takes the odometry's noise times {}", short_number(choice.odometry_sd_factor)));
  if (choice.observation_sd_factor != 1.0)
    parts.push_back(
        fmt::format("takes the observations' noise times {}", short_number(choice.observation_sd_factor)));
  for (const auto& [name, value] : choice.options) parts.push_back(name + ": " + option_text(value));
  return parts.empty() ? "no options" : joined_by(parts, ", ");
}

}  // namespace

std::optional<worlds::World> world_of(const std::filesystem::path& folder, const seif::Registry& registry) {
  if (!std::filesystem::exists(folder / "world.yaml")) return std::nullopt;
  return worlds::load_world(folder / "world.yaml", {}, estimator_schemas(registry)).world;
}

Description describe(const worlds::World& world) {
  const worlds::LandmarkSensor& sensor = world.landmark_sensor;
  Description about{"The world", world.description, {}};
  about.facts = {
      {"Name", world.name},
      {"Size of the ground",
       fmt::format("{} x {} m", short_number(world.ground_size.x()), short_number(world.ground_size.y()))},
      {"Landmarks", landmarks_text(world)},
      {"Walls and boxes", obstacles_text(world)},
      {"Duration and seed", fmt::format("{} s, seed {}", short_number(world.duration), world.seed)},
      {"Engine", engine_text(world.physics)},
      {"Friction", friction_text(world.physics)},
      {"Drive", drive_text(world.drive)},
      {"Wheel encoders", encoders_text(world.encoders)},
      {"Landmark sensor", fmt::format("{} scans a second, up to {} m, {} wide; ids {}", sensor.rate,
                                      short_number(sensor.max_range), in_degrees(sensor.fov),
                                      sensor.ids == worlds::LandmarkIds::known ? "known" : "hidden")},
      {"Noise of the sensor", noise_text(sensor.range_sd, sensor.range_sd_per_m, sensor.bearing_sd)},
      {"Start estimate",
       fmt::format("{} m along x, {} m along y, {} of heading (one sigma)",
                   short_number(world.start_estimate.x_sd), short_number(world.start_estimate.y_sd),
                   in_degrees(world.start_estimate.heading_sd))}};
  if (world.physics.engine == worlds::Engine::kinematic)
    std::erase_if(about.facts, [](const Fact& fact) { return fact.name == "Friction"; });
  if (const std::string mistakes = mistakes_text(sensor); !mistakes.empty())
    about.facts.push_back({"Mistakes of the sensor", mistakes});
  std::vector<std::string> faults;
  for (const worlds::Fault& fault : world.faults) faults.push_back(fault_text(fault));
  if (!faults.empty()) about.facts.push_back({"Faults on purpose", joined_by(faults, ", ")});
  return about;
}

Description describe(const LogDescription& log) {
  Description about{"The log", {}, {{"Name", log.name}}};
  about.facts.push_back({"Noise of the sensor",
                         noise_text(log.noise.range_sd, log.noise.range_sd_per_m, log.noise.bearing_sd)});
  if (log.max_range) about.facts.push_back({"Range of the sensor", short_number(*log.max_range) + " m"});
  about.facts.push_back({"Ids of landmarks", log.known_association ? "known" : "hidden"});
  return about;
}

Description describe(const std::vector<worlds::EstimatorChoice>& estimators) {
  Description about{"The estimators", {}, {}};
  for (const worlds::EstimatorChoice& choice : estimators)
    about.facts.push_back({choice.name, choice_text(choice)});
  return about;
}

}  // namespace harness
