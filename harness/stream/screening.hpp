// The door of the estimators: what comes in is looked at, and what no estimator can be given is left out,
// counted and told. Recorded is what passed, so a replay gets the same.
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

/// Why something is left out.
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

  /// Takes out of an event what is left out. False if nothing of it remains; a scan remains if it is empty.
  bool admit(Event& event);

  std::int64_t count(Rejection why) const { return counts_.at(static_cast<std::size_t>(why)); }
  /// When something was first left out. [s]
  std::optional<double> first_t() const { return first_t_; }

  /// Those that are not zero, under the names that the scores give them.
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
