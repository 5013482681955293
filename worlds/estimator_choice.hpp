// Which estimators run.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>

namespace worlds {

using OptionValue = std::variant<bool, std::int64_t, double, std::string>;

/// A factor for the noise that an estimator assumes is at most this, and at least its inverse. [-]
inline constexpr double largest_sd_factor = 1e6;

/// An estimator to run, under its own name. Only the estimator knows the meaning of its options.
struct EstimatorChoice {
  std::string name;
  std::string type;                    // the kind; by default the name
  std::string library;                 // path of the plug-in that has the type; empty: the program knows it
  double odometry_sd_factor = 1.0;     // [-] odometry noise that it assumes / noise that the sensor reports
  double observation_sd_factor = 1.0;  // [-] the same for observations
  std::map<std::string, OptionValue> options;  // a value for every option of the type
};

}  // namespace worlds
