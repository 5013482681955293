#include "harness/stream/screening.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "harness/stream/covariance_limits.hpp"

namespace harness {

namespace {

constexpr double longest_increment = 1e4;  // [m]
constexpr double longest_range = 2e5;      // [m] if the log does not give the sensor's range

// Noise alone hardly ever lifts a measured range further above the sensor's range than this.
constexpr double most_noise = 10.0;  // [sigma]

constexpr std::array<std::string_view, rejection_count> names = {
    "odometry_not_finite", "odometry_out_of_range", "observations_not_finite", "observations_out_of_range"};

bool is_finite(const seif::Odometry& odometry) {
  const seif::Pose2& T = odometry.T_previous_current;
  return std::isfinite(odometry.t) && std::isfinite(T.x) && std::isfinite(T.y) && std::isfinite(T.theta) &&
         odometry.covariance.allFinite();
}

bool is_in_range(const seif::Odometry& odometry) {
  const seif::Pose2& T = odometry.T_previous_current;
  return std::abs(T.x) <= longest_increment && std::abs(T.y) <= longest_increment &&
         (odometry.covariance.diagonal().array() >= 0.0).all() &&
         problem_of_motion(odometry.covariance).empty();
}

bool is_finite(const seif::Observation& observation) {
  return std::isfinite(observation.range) && std::isfinite(observation.bearing) &&
         observation.covariance.allFinite();
}

bool is_in_range(const seif::Observation& observation, double longest) {
  const Eigen::Matrix2d& Q = observation.covariance;
  return observation.range >= 0.0 &&
         observation.range <= longest + most_noise * std::sqrt(std::max(0.0, Q(0, 0))) &&
         problem_of_observation(Q).empty();
}

}  // namespace

Screening::Screening(const LogDescription& log) : longest_range_(log.max_range.value_or(longest_range)) {}

bool Screening::admit(Event& event) {
  if (auto* scan = std::get_if<ScanEvent>(&event)) return admit(*scan);
  return admit(std::get<OdometryEvent>(event));
}

bool Screening::admit(const OdometryEvent& event) {
  if (!is_finite(event.odometry)) {
    reject(Rejection::odometry_not_finite, event.odometry.t);
    return false;
  }
  if (is_in_range(event.odometry)) return true;
  reject(Rejection::odometry_out_of_range, event.odometry.t);
  return false;
}

bool Screening::admit(ScanEvent& event) {
  std::vector<seif::Observation>& seen = event.scan.observations;
  const bool has_ids = event.true_ids.size() == seen.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!is_finite(seen[i])) {
      reject(Rejection::observations_not_finite, event.scan.t);
    } else if (!is_in_range(seen[i], longest_range_)) {
      reject(Rejection::observations_out_of_range, event.scan.t);
    } else {
      if (has_ids) event.true_ids[kept] = event.true_ids[i];
      seen[kept++] = seen[i];
    }
  }
  seen.resize(kept);
  if (has_ids) event.true_ids.resize(kept);
  return true;
}

void Screening::reject(Rejection why, double t) {
  ++counts_.at(static_cast<std::size_t>(why));
  if (!first_t_) first_t_ = t;
}

std::vector<std::pair<std::string_view, std::int64_t>> Screening::named() const {
  std::vector<std::pair<std::string_view, std::int64_t>> named;
  for (std::size_t i = 0; i < rejection_count; ++i) {
    if (counts_[i] > 0) named.emplace_back(names[i], counts_[i]);
  }
  return named;
}

}  // namespace harness
