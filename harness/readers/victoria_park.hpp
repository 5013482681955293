// The Victoria Park data set: speeds and steering angles of a car, and trees without ids.
#pragma once

#include <filesystem>
#include <optional>

#include "harness/files/row_reader.hpp"
#include "harness/readers/log_noise.hpp"
#include "harness/readers/velocity_log.hpp"

namespace harness {

/// The robot's origin is the middle of the rear axle; the sensor is the laser. The true tree of an
/// observation is not known: description().known_association is false. All functions throw BadInput.
class VictoriaParkLog final : public VelocityLog {
 public:
  explicit VictoriaParkLog(const std::filesystem::path& folder);

  static bool is_in(const std::filesystem::path& folder);
  static LogNoise default_noise();

 protected:
  std::optional<VelocityRow> read_velocity() override;
  std::optional<ObservationRow> read_observation() override;

 private:
  RowReader velocity_rows_;
  RowReader observation_rows_;
  std::optional<double> velocity_t_;     // [s] of the last row
  std::optional<double> observation_t_;  // [s]
};

/// The velocity of the middle of the rear axle. The left rear wheel rolls at `wheel_speed` [m/s], and the car
/// steers by `steering` [rad], positive to the left.
VelocityRow car_velocity(double t, double wheel_speed, double steering);

}  // namespace harness
