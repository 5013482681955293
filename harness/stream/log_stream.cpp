#include "harness/stream/log_stream.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "harness/stream/covariance_columns.hpp"
#include "harness/stream/covariance_limits.hpp"

namespace harness {

namespace {

constexpr std::int64_t largest_id = std::numeric_limits<seif::LandmarkId>::max() - 1;
constexpr std::size_t largest_scan = 10'000;  // [-] observations; a larger "scan" comes from a broken clock

constexpr double longest_rest = 1.0;  // [s] a scan this long after the last odometry is no chance

// Columns of observations.csv.
constexpr int landmark_column = 1;
constexpr int range_column = 2;
constexpr int bearing_column = 3;
constexpr int first_covariance_column = 4;

std::filesystem::path existing_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw BadInput(fmt::format("{}: there is no such folder", folder.string()));
  return folder;
}

/// The time of a row. It must not go backwards.
double read_time(const CsvReader& rows, double earliest, bool may_repeat) {
  const double t = rows.number(0);
  if (t < earliest || (t == earliest && !may_repeat))
    rows.fail(0, fmt::format("{} s does not come after {} s, where the log was before", t, earliest));
  return t;
}

bool has_time_alone(const CsvReader& row) {
  for (int column = landmark_column; column < first_covariance_column + 3; ++column) {
    if (!row.is_empty(column)) return false;
  }
  return true;
}

bool is_positive_semidefinite(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  const double rounding = 1e-9 * covariance.diagonal().cwiseAbs().maxCoeff();
  return solver.info() == Eigen::Success && solver.eigenvalues().minCoeff() >= -rounding;
}

}  // namespace

TruthReader::TruthReader(const std::filesystem::path& file, double longest_gap)
    : rows_(file, {{"t", "x", "y", "theta"}, {"left_wheel", "right_wheel"}}), track_(longest_gap) {}

TruthReader::TruthReader(const std::filesystem::path& folder)
    : TruthReader(folder / "truth.csv", longest_truth_gap(folder / "log.yaml")) {}

std::optional<TruePose> TruthReader::next_row() {
  if (!rows_.next()) return std::nullopt;
  TruePose row;
  row.t = read_time(rows_, last_t_.value_or(-std::numeric_limits<double>::infinity()), false);
  last_t_ = row.t;
  row.T_world_robot = {rows_.number(1), rows_.number(2), seif::wrap_angle(rows_.number(3))};
  if (rows_.has_optional()) {
    row.left_wheel = rows_.number(4);
    row.right_wheel = rows_.number(5);
  }
  return row;
}

std::optional<TruePose> TruthReader::at(double t) {
  return track_.at(t, [this] { return next_row(); });
}

std::vector<TrueLandmark> read_landmarks(const std::filesystem::path& file) {
  CsvReader rows(file, {{"landmark", "x", "y"}, {"radius"}});
  std::vector<TrueLandmark> landmarks;
  while (rows.next()) {
    TrueLandmark landmark;
    landmark.landmark = static_cast<seif::LandmarkId>(rows.integer(0, 0, largest_id));
    landmark.position = {rows.number(1), rows.number(2)};
    if (rows.has_optional()) landmark.radius = rows.number(3);
    landmarks.push_back(landmark);
  }
  std::ranges::sort(landmarks, {}, &TrueLandmark::landmark);
  const auto twice = std::ranges::adjacent_find(landmarks, {}, &TrueLandmark::landmark);
  if (twice != landmarks.end())
    throw BadInput(fmt::format("{}: landmark {} stands there twice", file.string(), twice->landmark));
  return landmarks;
}

LogStream::LogStream(const std::filesystem::path& folder)
    : odometry_rows_(
          existing_folder(folder) / "odometry.csv",
          {{"t", "dx", "dy", "dtheta", "cov_xx", "cov_xy", "cov_xt", "cov_yy", "cov_yt", "cov_tt"}, {}}),
      observation_rows_(folder / "observations.csv",
                        {{"t", "landmark", "range", "bearing"}, {"cov_rr", "cov_rb", "cov_bb"}}) {
  read_yaml(folder / "log.yaml", description_);
  if (std::filesystem::exists(folder / "truth.csv")) {
    truth_.emplace(folder / "truth.csv", description_.longest_truth_gap);
    description_.has_truth = true;
    description_.has_wheel_angles = truth_->has_wheel_angles();
    description_.true_start = truth_->at(description_.start_t);
  }
  if (std::filesystem::exists(folder / "landmarks.csv"))
    description_.landmarks = read_landmarks(folder / "landmarks.csv");
  if (std::filesystem::exists(folder / "observations_true_ids.csv")) {
    true_id_rows_.emplace(folder / "observations_true_ids.csv", Columns{{"t", "true_landmark"}, {}});
    description_.has_true_ids = true;
  }
  odometry_.t = description_.start_t;
  observation_t_ = description_.start_t;
  read_odometry_row();
  read_observation_row();
}

void LogStream::read_odometry_row() {
  odometry_left_ = odometry_rows_.next();
  if (!odometry_left_) return;
  odometry_.t = read_time(odometry_rows_, odometry_.t, false);
  odometry_.T_previous_current = {odometry_rows_.number(1), odometry_rows_.number(2),
                                  seif::wrap_angle(odometry_rows_.number(3))};
  odometry_.covariance = read_covariance<3>(odometry_rows_, 4);
  if (!is_positive_semidefinite(odometry_.covariance))
    odometry_rows_.fail(4, "this covariance has a negative eigenvalue");
  const std::string problem = problem_of_motion(odometry_.covariance);
  if (!problem.empty()) odometry_rows_.fail(4, problem);
}

void LogStream::read_observation_row() {
  observation_left_ = observation_rows_.next();
  if (observation_left_) observation_t_ = read_time(observation_rows_, observation_t_, true);
}

bool LogStream::scan_is_due() const {
  if (!observation_left_) return false;
  return !odometry_left_ || observation_t_ < odometry_.t;
}

bool LogStream::next(Event& event) {
  if (!odometry_left_ && !observation_left_) return false;
  if (scan_is_due()) {
    if (!odometry_left_ && observation_t_ - odometry_.t > longest_rest) ++counts_.scans_after_odometry;
    fill(memory_.scan(event));
    return true;
  }
  OdometryEvent& odometry = memory_.odometry(event);
  odometry.odometry = odometry_;
  odometry.truth = truth_at(odometry_.t);
  read_odometry_row();
  return true;
}

std::optional<TruePose> LogStream::truth_at(double t) {
  // Odometry and a scan at the same time share the truth.
  if (truth_ && !(last_truth_ && last_truth_->t == t)) last_truth_ = truth_->at(t);
  return last_truth_;
}

/// Gathers all rows with the same time into one scan.
void LogStream::fill(ScanEvent& event) {
  event.scan.t = observation_t_;
  event.scan.observations.clear();
  event.true_ids.clear();
  event.truth = truth_at(observation_t_);
  int rows = 0;
  bool is_empty = false;
  do {
    ++rows;
    if (is_empty) observation_rows_.fail(0, "an empty scan has no other rows at its time");
    is_empty = has_time_alone(observation_rows_);
    if (is_empty && rows > 1)
      observation_rows_.fail(landmark_column, "an empty scan has no other rows at its time");
    if (true_id_rows_ && !true_id_rows_->next())
      observation_rows_.fail(0, "observations_true_ids.csv has no row for this one");
    if (!is_empty) add_observation(event);
    read_observation_row();
  } while (observation_left_ && observation_t_ == event.scan.t);
}

void LogStream::add_observation(ScanEvent& event) {
  std::vector<seif::Observation>& seen = event.scan.observations;
  if (seen.size() == largest_scan)
    observation_rows_.fail(0, fmt::format("more than {} observations at one time", largest_scan));
  const seif::Observation now = observation();
  if (now.landmark != seif::no_landmark &&
      std::ranges::find(seen, now.landmark, &seif::Observation::landmark) != seen.end())
    observation_rows_.fail(landmark_column,
                           fmt::format("landmark {} stands twice in one scan", now.landmark));
  seen.push_back(now);
  if (!true_id_rows_) return;
  event.true_ids.push_back(true_id_rows_->is_empty(1)
                               ? seif::no_landmark
                               : static_cast<seif::LandmarkId>(true_id_rows_->integer(1, 0, largest_id)));
}

seif::Observation LogStream::observation() const {
  const CsvReader& row = observation_rows_;
  seif::Observation observation;
  if (description_.known_association) {
    if (row.is_empty(landmark_column))
      row.fail(landmark_column, "is missing; in log.yaml stands association: known");
    observation.landmark = static_cast<seif::LandmarkId>(row.integer(landmark_column, 0, largest_id));
  } else if (!row.is_empty(landmark_column)) {
    row.fail(landmark_column, "must be empty; in log.yaml stands association: unknown");
  }
  observation.range = row.number(range_column);
  if (observation.range < 0.0) row.fail(range_column, "is negative");
  observation.bearing = seif::wrap_angle(row.number(bearing_column));
  observation.covariance = row.has_optional() ? read_covariance<2>(row, first_covariance_column)
                                              : covariance(description_.noise, observation.range);
  const std::string problem = problem_of_observation(observation.covariance);
  if (!problem.empty()) row.fail(first_covariance_column, problem);
  return observation;
}

}  // namespace harness
