#include "harness/stream/log_description.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/files/bad_input.hpp"
#include "harness/stream/covariance_limits.hpp"
#include "worlds/document.hpp"
#include "worlds/fields.hpp"

namespace harness {

namespace {

void describe_pose(worlds::Fields& fields, seif::Pose2& pose, worlds::Need need) {
  fields.number("x_m", pose.x, worlds::any_number(), "x of the origin", need);
  fields.number("y_m", pose.y, worlds::any_number(), "y of the origin", need);
  fields.number("theta_rad", pose.theta, worlds::any_number(), "heading, counter-clockwise", need);
}

/// Describes a symmetric (3 x 3) matrix of [x y theta] by six named numbers.
void describe_covariance(worlds::Fields& fields, Eigen::Matrix3d& covariance) {
  using worlds::Need;
  const auto element = [&](const char* key, int row, int column, Need need) {
    fields.number(key, covariance(row, column), worlds::any_number(), "element of the covariance [m, rad]",
                  need);
    covariance(column, row) = covariance(row, column);
  };
  element("cov_xx", 0, 0, Need::required);
  element("cov_xy", 0, 1, Need::defaulted);
  element("cov_xt", 0, 2, Need::defaulted);
  element("cov_yy", 1, 1, Need::required);
  element("cov_yt", 1, 2, Need::defaulted);
  element("cov_tt", 2, 2, Need::required);
}

void describe_start(worlds::Fields& fields, LogDescription& log) {
  fields.number("t_s", log.start_t, worlds::any_number(),
                "time at which the first odometry increment begins");
  describe_pose(fields, log.start.mean, worlds::Need::required);
  describe_covariance(fields, log.start.covariance);
  if (!fields.sound()) return;
  const std::string problem = problem_of_start(log.start.covariance);
  if (!problem.empty()) fields.problem("cov_xx", problem);
}

void describe(worlds::Fields& fields, LogDescription& log, std::string& association) {
  fields.text("name", log.name, "name of the log", worlds::Need::required);
  fields.choice("association", association, {"known", "unknown"}, "whether observations name their landmark");
  fields.section("sensor_mount", "where the landmark sensor sits on the robot", [&](worlds::Fields& mount) {
    describe_pose(mount, log.T_robot_sensor, worlds::Need::defaulted);
  });
  fields.number("range_sd_m", log.noise.range_sd, worlds::between(least_sd, largest_observation_sd),
                "error of a range", worlds::Need::required);
  fields.number("range_sd_per_m", log.noise.range_sd_per_m, worlds::at_least(0),
                "error of a range for each metre");
  fields.number("bearing_sd_rad", log.noise.bearing_sd, worlds::between(least_sd, largest_observation_sd),
                "error of a bearing", worlds::Need::required);
  double max_range = 0.0;  // stays 0 if the file does not give it
  fields.number("max_range_m", max_range, worlds::more_than(0),
                "of the sensor: what is longer is no measurement", worlds::Need::optional);
  if (max_range > 0.0) log.max_range = max_range;
  fields.number("truth_gap_s", log.longest_truth_gap, worlds::more_than(0),
                "between true poses that are further apart there is no truth; left out: there is",
                worlds::Need::optional);
  fields.section("start", "the pose from which the estimators begin",
                 [&](worlds::Fields& start) { describe_start(start, log); });
}

}  // namespace

Eigen::Matrix2d covariance(const SensorNoise& noise, double range) {
  const double range_part = noise.range_sd_per_m * range;
  return Eigen::Vector2d(noise.range_sd * noise.range_sd + range_part * range_part,
                         noise.bearing_sd * noise.bearing_sd)
      .asDiagonal();
}

std::string to_yaml(const LogDescription& log) {
  const seif::Pose2& mount = log.T_robot_sensor;
  const seif::Pose2& start = log.start.mean;
  const Eigen::Matrix3d& P = log.start.covariance;
  const std::string max_range = log.max_range ? fmt::format("max_range_m: {}\n", *log.max_range) : "";
  const std::string truth_gap =
      std::isfinite(log.longest_truth_gap) ? fmt::format("truth_gap_s: {}\n", log.longest_truth_gap) : "";
  return fmt::format(
      "name: {}\n"
      "association: {}\n"
      "sensor_mount: {{x_m: {}, y_m: {}, theta_rad: {}}}\n"
      "range_sd_m: {}\n"
      "range_sd_per_m: {}\n"
      "bearing_sd_rad: {}\n"
      "{}{}"
      "start:\n"
      "  t_s: {}\n"
      "  x_m: {}\n"
      "  y_m: {}\n"
      "  theta_rad: {}\n"
      "  cov_xx: {}\n"
      "  cov_xy: {}\n"
      "  cov_xt: {}\n"
      "  cov_yy: {}\n"
      "  cov_yt: {}\n"
      "  cov_tt: {}\n",
      nlohmann::json(log.name).dump(), log.known_association ? "known" : "unknown", mount.x, mount.y,
      mount.theta, log.noise.range_sd, log.noise.range_sd_per_m, log.noise.bearing_sd, max_range, truth_gap,
      log.start_t, start.x, start.y, start.theta, P(0, 0), P(0, 1), P(0, 2), P(1, 1), P(1, 2), P(2, 2));
}

void read_yaml(const std::filesystem::path& file, LogDescription& description) {
  std::vector<worlds::Problem> problems;
  std::optional<worlds::Node> document = worlds::read_document(file, problems);
  std::string association = "known";
  if (document) {
    worlds::read_fields(
        *document, [&](worlds::Fields& fields) { describe(fields, description, association); }, problems);
  }
  description.known_association = association == "known";
  if (problems.empty()) return;
  worlds::sort_by_place(problems);
  std::string message;
  for (const worlds::Problem& problem : problems) {
    if (!message.empty()) message += '\n';
    message += worlds::to_string(problem);
  }
  throw BadInput(message);
}

double longest_truth_gap(const std::filesystem::path& file) {
  LogDescription description;
  if (std::filesystem::exists(file)) read_yaml(file, description);
  return description.longest_truth_gap;
}

}  // namespace harness
