// Checks every event before the estimators get it. Invalid measurements are left out, counted and reported.
// Only what passed is recorded, so a replay gets the same events.
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

/// The reason for leaving something out.
enum class Rejection {
  odometry_not_finite,
  odometry_out_of_range,  // an impossible distance for one increment, or an invalid covariance
  observations_not_finite,
  observations_out_of_range  // a range that is negative or above the sensor's, or an invalid covariance
};
inline constexpr std::size_t rejection_count = 4;  // [-]

class Screening {
 public:
  explicit Screening(const LogDescription& log);

  /// Removes what is invalid from an event. False if nothing remains; a scan remains even if it is empty.
  bool admit(Event& event);

  std::int64_t count(Rejection why) const { return counts_.at(static_cast<std::size_t>(why)); }
  /// The time at which something was first left out. [s]
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
