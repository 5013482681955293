// Checks measurements before the estimators get them. Invalid ones are ignored, counted and reported. Only valid
// ones are recorded, so a replay gets the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/stream/log_description.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

/// Why a measurement is ignored.
enum class Rejection {
  odometry_not_finite,
  odometry_out_of_range,  // farther than any robot drives in one increment, or an invalid covariance
  observations_not_finite,
  observations_out_of_range  // a range below zero or beyond the sensor's, or an invalid covariance
};
inline constexpr std::size_t rejection_count = 4;  // [-]

class Screening {
 public:
  explicit Screening(const LogDescription& log);

  /// Removes the invalid measurements of an event. False if nothing remains; an empty scan remains a scan.
  bool admit(Event& event);

  std::int64_t count(Rejection why) const { return counts_.at(static_cast<std::size_t>(why)); }
  /// The time of the first ignored measurement. [s]
  std::optional<double> first_t() const { return first_t_; }

  /// The counts that are not zero, with their names in the scores.
  std::vector<std::pair<std::string_view, std::int64_t>> named() const;

 private:
  bool admit(const OdometryEvent& event);
  bool admit(ScanEvent& event);
  void reject(Rejection why, double t);

  double longest_range_;  // [m]
  std::array<std::int64_t, rejection_count> counts_ = {};
  std::optional<double> first_t_;
};

}  // namespace harness
