#include "harness/readers/mrclam.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/readers/landmark_rows.hpp"
#include "harness/readers/number_rows.hpp"

namespace harness {

namespace {

constexpr seif::LandmarkId last_robot = 5;  // subjects 1 to 5 are robots
constexpr double truth_gap = 0.5;           // [s] the cameras took a picture every 0.01 s
constexpr double mrclam_start_sd = 0.01;    // [m, rad] of the motion capture, with a margin

std::map<std::int64_t, seif::LandmarkId> read_barcodes(const std::filesystem::path& file) {
  RowReader rows(file, ' ');
  std::map<std::int64_t, seif::LandmarkId> subjects;
  while (next_row(rows, 2)) {
    const auto subject = static_cast<seif::LandmarkId>(rows.integer(0, "subject", 1, largest_id));
    const std::int64_t barcode = rows.integer(1, "barcode", 0, largest_id);
    if (!subjects.emplace(barcode, subject).second) rows.fail(1, "barcode: stands there twice");
  }
  return subjects;
}

std::vector<TrueLandmark> read_true_landmarks(const std::filesystem::path& file) {
  RowReader rows(file, ' ');
  std::vector<TrueLandmark> landmarks;
  while (next_row(rows, 5)) {
    const auto subject = static_cast<seif::LandmarkId>(rows.integer(0, "subject", 1, largest_id));
    landmarks.push_back({subject, {rows.number(1, "x"), rows.number(2, "y")}, 0.0});
  }
  sort_by_id(landmarks, file, "subject");
  return landmarks;
}

std::filesystem::path file_of(const std::filesystem::path& folder, int robot, const char* kind) {
  return folder / fmt::format("Robot{}_{}.dat", robot, kind);
}

}  // namespace

bool MrclamLog::is_in(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "Barcodes.dat");
}

LogNoise MrclamLog::default_noise() {
  return {.odometry = OdometryNoise{0.1, 0.1, 0.2, 0.2}, .sensor = SensorNoise{0.3, 0.05, 0.15}};
}

MrclamLog::MrclamLog(const std::filesystem::path& folder, int robot)
    : subjects_(read_barcodes(folder / "Barcodes.dat")),
      velocity_rows_(file_of(folder, robot, "Odometry"), ' '),
      observation_rows_(file_of(folder, robot, "Measurement"), ' ') {
  description_.name = fmt::format("{}-robot{}", folder.filename().string(), robot);
  description_.noise = *default_noise().sensor;
  if (const auto landmarks = folder / "Landmark_Groundtruth.dat"; std::filesystem::exists(landmarks))
    description_.landmarks = read_true_landmarks(landmarks);
  if (const auto truth = file_of(folder, robot, "Groundtruth"); std::filesystem::exists(truth)) {
    truth_rows_.emplace(truth, ' ');
    description_.has_truth = true;
    description_.longest_truth_gap = truth_gap;
  }
  begin();
  if (description_.true_start) description_.start.mean = description_.true_start->T_world_robot;
  description_.start.covariance = mrclam_start_sd * mrclam_start_sd * Eigen::Matrix3d::Identity();
}

std::optional<VelocityRow> MrclamLog::read_velocity() {
  const auto row =
      next_numbers<0, 3>(velocity_rows_, {"time", "velocity", "angular velocity"}, velocity_t_, counts_);
  if (!row) return std::nullopt;
  return VelocityRow{(*row)[0], (*row)[1], (*row)[2]};
}

std::optional<ObservationRow> MrclamLog::read_observation() {
  while (const auto row = next_numbers<0, 4>(observation_rows_, {"time", "barcode", "range", "bearing"},
                                             observation_t_, counts_)) {
    const std::int64_t barcode = observation_rows_.integer(1, "barcode", 0, largest_id);
    const auto [t, unused, range, bearing] = *row;
    const auto subject = subjects_.find(barcode);
    if (subject == subjects_.end()) {
      ++counts_.unknown_ids;
    } else if (subject->second <= last_robot) {
      ++counts_.robots;
    } else if (range < 0.0) {
      ++counts_.negative_ranges;
    } else {
      return ObservationRow{t, {subject->second, range, seif::wrap_angle(bearing), Eigen::Matrix2d::Zero()}};
    }
  }
  return std::nullopt;
}

std::optional<TruePose> MrclamLog::read_truth() {
  if (!truth_rows_) return std::nullopt;
  const std::optional<double> before = truth_t_;
  const auto row = next_numbers<0, 4>(*truth_rows_, {"time", "x", "y", "orientation"}, truth_t_, counts_);
  if (!row) return std::nullopt;
  const auto [t, x, y, theta] = *row;
  if (before && t - *before > truth_gap) ++counts_.truth_gaps;
  return TruePose{.t = t, .T_world_robot = {x, y, seif::wrap_angle(theta)}};
}

}  // namespace harness
