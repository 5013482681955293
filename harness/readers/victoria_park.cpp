#include "harness/readers/victoria_park.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "harness/readers/number_rows.hpp"

namespace harness {

namespace {

// The car of Guivant and Nebot. L, H, a and b are their symbols.
constexpr double wheel_base = 2.83;   // [m] L, from axle to axle
constexpr double half_track = 0.76;   // [m] H, from the middle of the rear axle to the wheel with the encoder
constexpr double laser_ahead = 3.78;  // [m] a, from the rear axle forward
constexpr double laser_beside = 0.5;  // [m] b, to the left
constexpr double park_start_sd = 1e-3;   // [m, rad] the frame is that of the first pose
constexpr double widest_steering = 1.2;  // [rad] no car steers that far; the model has a pole at 1.3

}  // namespace

bool VictoriaParkLog::is_in(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "derived_tree_detections.txt");
}

LogNoise VictoriaParkLog::default_noise() {
  return {.odometry = OdometryNoise{0.1, 0.05, 0.01, 0.05}, .sensor = SensorNoise{0.3, 0.0, 0.03}};
}

VelocityRow car_velocity(double t, double wheel_speed, double steering) {
  const double v = wheel_speed / (1.0 - std::tan(steering) * half_track / wheel_base);
  return {t, v, v / wheel_base * std::tan(steering)};
}

VictoriaParkLog::VictoriaParkLog(const std::filesystem::path& folder)
    : velocity_rows_(folder / "derived_odometry.txt", ' '),
      observation_rows_(folder / "derived_tree_detections.txt", ' ') {
  description_.name = "victoria_park";
  description_.T_robot_sensor = {laser_ahead, laser_beside, 0.0};
  description_.noise = *default_noise().sensor;
  description_.start.covariance = park_start_sd * park_start_sd * Eigen::Matrix3d::Identity();
  description_.known_association = false;
  begin();
}

std::optional<VelocityRow> VictoriaParkLog::read_velocity() {
  const auto row = next_numbers<0, 3>(velocity_rows_, {"time", "speed", "steering"}, velocity_t_, counts_);
  if (!row) return std::nullopt;
  const auto [t, speed, steering] = *row;
  if (std::abs(steering) > widest_steering)
    velocity_rows_.fail(2, fmt::format("steering: is more than {} rad", widest_steering));
  return car_velocity(t, speed, steering);
}

std::optional<ObservationRow> VictoriaParkLog::read_observation() {
  while (const auto row = next_numbers<1, 5>(
             observation_rows_, {"scan", "time", "range", "bearing", "diameter"}, observation_t_, counts_)) {
    const auto [scan, t, range, bearing, diameter] = *row;
    if (range < 0.0) {
      ++counts_.negative_ranges;
    } else {
      return ObservationRow{t,
                            {seif::no_landmark, range, seif::wrap_angle(bearing), Eigen::Matrix2d::Zero()}};
    }
  }
  return std::nullopt;
}

}  // namespace harness
