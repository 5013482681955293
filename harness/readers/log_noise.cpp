#include "harness/readers/log_noise.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "harness/files/bad_input.hpp"
#include "harness/stream/covariance_limits.hpp"
#include "worlds/document.hpp"
#include "worlds/merge.hpp"

namespace harness {

namespace {

constexpr std::array<std::string_view, 4> odometry_keys = {
    "distance_sd_m_per_sqrt_m", "sideways_sd_m_per_sqrt_m", "turn_sd_rad_per_sqrt_m",
    "turn_sd_rad_per_sqrt_rad"};
constexpr std::array<std::string_view, 3> sensor_keys = {"range_sd_m", "range_sd_per_m", "bearing_sd_rad"};

void describe(worlds::Fields& fields, OdometryNoise& noise) {
  using worlds::at_least;
  fields.number(odometry_keys[0], noise.distance_sd_per_sqrt_m, at_least(0), "error along the way");
  fields.number(odometry_keys[1], noise.sideways_sd_per_sqrt_m, at_least(0), "error across the way");
  fields.number(odometry_keys[2], noise.turn_sd_per_sqrt_m, at_least(0), "error of the heading by the way");
  fields.number(odometry_keys[3], noise.turn_sd_per_sqrt_rad, at_least(0), "error of the heading by turns");
}

void describe(worlds::Fields& fields, SensorNoise& noise) {
  fields.number(sensor_keys[0], noise.range_sd, worlds::between(least_sd, largest_observation_sd),
                "error of a range");
  fields.number(sensor_keys[1], noise.range_sd_per_m, worlds::at_least(0), "error of a range by its length");
  fields.number(sensor_keys[2], noise.bearing_sd, worlds::between(least_sd, largest_observation_sd),
                "error of a bearing");
}

template <std::size_t Count>
bool has_any(const worlds::Node& document, const std::array<std::string_view, Count>& keys) {
  for (const std::string_view key : keys) {
    if (document.find(key) != nullptr) return true;
  }
  return false;
}

/// Everything that was chosen, as one document.
worlds::Node document_of(const NoiseChoices& choices, std::vector<worlds::Problem>& problems) {
  worlds::Node root;
  root.kind = worlds::Node::Kind::map;
  if (!choices.file.empty()) {
    if (auto document = worlds::read_document(choices.file, problems))
      root.entries.push_back({"noise", {}, std::move(*document)});
  }
  for (const std::string& assignment : choices.overrides) worlds::apply_override(root, assignment, problems);
  const worlds::Node* noise = root.find("noise");
  return noise != nullptr ? *noise : worlds::Node{};
}

void throw_if_any(const std::vector<worlds::Problem>& problems) {
  if (!problems.empty()) throw BadInput(worlds::to_string(problems.front()));
}

}  // namespace

Eigen::Matrix3d covariance(const OdometryNoise& noise, const seif::Pose2& T_previous_current) {
  const double way = std::hypot(T_previous_current.x, T_previous_current.y);
  const double turn = std::abs(T_previous_current.theta);
  const auto squared = [](double value) { return value * value; };
  return Eigen::Vector3d(squared(noise.distance_sd_per_sqrt_m) * way,
                         squared(noise.sideways_sd_per_sqrt_m) * way,
                         squared(noise.turn_sd_per_sqrt_m) * way + squared(noise.turn_sd_per_sqrt_rad) * turn)
      .asDiagonal();
}

LogNoise read_noise(const NoiseChoices& choices, const LogNoise& fallback) {
  if (choices.empty()) return fallback;
  std::vector<worlds::Problem> problems;
  worlds::Node document = document_of(choices, problems);
  throw_if_any(problems);
  LogNoise noise = fallback;
  if (has_any(document, odometry_keys)) noise.odometry = noise.odometry.value_or(OdometryNoise{});
  if (has_any(document, sensor_keys)) noise.sensor = noise.sensor.value_or(SensorNoise{});
  const auto describe_all = [&](worlds::Fields& fields) {
    // Noise that stays as recorded: its keys are allowed, but their values are not used.
    OdometryNoise no_odometry;
    SensorNoise no_sensor{1.0, 0.0, 1.0};
    describe(fields, noise.odometry ? *noise.odometry : no_odometry);
    describe(fields, noise.sensor ? *noise.sensor : no_sensor);
  };
  worlds::read_fields(document, describe_all, problems);
  throw_if_any(problems);
  if (noise.sensor && !(noise.sensor->range_sd > 0.0 && noise.sensor->bearing_sd > 0.0))
    throw BadInput(
        "noise: the noise of this log's sensor stands in its rows, or nowhere, and is replaced as a whole: "
        "say "
        "both, as in --set noise.range_sd_m=0.1 --set noise.bearing_sd_rad=0.02");
  return noise;
}

std::string to_yaml(const LogNoise& noise) {
  std::string text;
  const auto line = [&](std::string_view key, double value) { text += fmt::format("{}: {}\n", key, value); };
  if (noise.odometry) {
    line(odometry_keys[0], noise.odometry->distance_sd_per_sqrt_m);
    line(odometry_keys[1], noise.odometry->sideways_sd_per_sqrt_m);
    line(odometry_keys[2], noise.odometry->turn_sd_per_sqrt_m);
    line(odometry_keys[3], noise.odometry->turn_sd_per_sqrt_rad);
  }
  if (noise.sensor) {
    line(sensor_keys[0], noise.sensor->range_sd);
    line(sensor_keys[1], noise.sensor->range_sd_per_m);
    line(sensor_keys[2], noise.sensor->bearing_sd);
  }
  return text;
}

}  // namespace harness
