#include "harness/readers/freiburg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/readers/landmark_rows.hpp"

namespace harness {

namespace {

constexpr double freiburg_start_sd = 1e-3;  // [m, rad] the robot starts at the origin

std::vector<TrueLandmark> read_world(const std::filesystem::path& file) {
  RowReader rows(file, ' ');
  std::vector<TrueLandmark> landmarks;
  while (rows.next()) {
    if (rows.size() == 0 || rows.is_comment()) continue;
    if (rows.size() > 3) rows.fail(3, "a landmark has an id, x and y, and nothing else");
    landmarks.push_back({static_cast<seif::LandmarkId>(rows.integer(0, "id", 0, largest_id)),
                         {rows.number(1, "x"), rows.number(2, "y")},
                         0.0});
  }
  sort_by_id(landmarks, file, "landmark");
  return landmarks;
}

}  // namespace

LogNoise FreiburgLog::default_noise() {
  return {.odometry = OdometryNoise{0.1, 0.0, 0.05, 0.05}, .sensor = SensorNoise{0.1, 0.0, 0.1}};
}

FreiburgLog::FreiburgLog(const std::filesystem::path& sensor_data) : rows_(sensor_data, ' ') {
  description_.name = "freiburg";
  description_.noise = *default_noise().sensor;
  description_.start.covariance = freiburg_start_sd * freiburg_start_sd * Eigen::Matrix3d::Identity();
  const std::filesystem::path world = sensor_data.parent_path() / "world.dat";
  if (std::filesystem::exists(world)) description_.landmarks = read_world(world);
  row_left_ = read_row();
}

bool FreiburgLog::read_row() {
  while (rows_.next()) {
    if (rows_.size() == 0 || rows_.is_comment()) continue;
    const std::string_view word = rows_.cell(0);
    if (word != "ODOMETRY" && word != "SENSOR")
      rows_.fail(0, fmt::format("'{}' is neither ODOMETRY nor SENSOR", word));
    if (rows_.size() > 4) rows_.fail(4, "a record has three values");
    return true;
  }
  return false;
}

bool FreiburgLog::next(Event& event) {
  if (!row_left_) return false;
  if (rows_.cell(0) == "SENSOR") {
    fill(memory_.scan(event));
    return true;
  }
  const seif::Pose2 before{0.0, 0.0, seif::wrap_angle(rows_.number(1, "first rotation"))};
  const seif::Pose2 ahead{rows_.number(2, "translation"), 0.0, 0.0};
  const seif::Pose2 after{0.0, 0.0, seif::wrap_angle(rows_.number(3, "second rotation"))};
  t_ += 1.0;
  memory_.odometry(event) = {{t_, before * ahead * after, Eigen::Matrix3d::Zero()}, std::nullopt};
  row_left_ = read_row();
  return true;
}

void FreiburgLog::fill(ScanEvent& event) {
  begin_scan(event, t_, std::nullopt);
  for (; row_left_ && rows_.cell(0) == "SENSOR"; row_left_ = read_row()) add_observation(event);
}

void FreiburgLog::add_observation(ScanEvent& event) {
  seif::Observation now;
  now.landmark = static_cast<seif::LandmarkId>(rows_.integer(1, "landmark", 0, largest_id));
  now.range = rows_.number(2, "range", Finite::not_required);
  now.bearing = rows_.number(3, "bearing", Finite::not_required);
  if (!std::isfinite(now.range) || !std::isfinite(now.bearing)) {
    ++counts_.not_finite;
    return;
  }
  if (now.range < 0.0) {
    ++counts_.negative_ranges;
    return;
  }
  now.bearing = seif::wrap_angle(now.bearing);
  add_once(now, event, counts_);
}

}  // namespace harness
