// An estimator in a run.
#pragma once

#include <memory>
#include <string>

#include "seif/estimator.hpp"

namespace harness {

struct LiveEstimator {
  std::string name;
  std::unique_ptr<seif::Estimator> filter;
  double odometry_sd_factor = 1.0;     // [-] odometry noise that it assumes, relative to the data's
  double observation_sd_factor = 1.0;  // [-] the same for observations
  std::string failure;                 // why it was removed from the run; empty: it still runs
};

}  // namespace harness
