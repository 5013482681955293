// Options of estimators that change during a run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/run/live_estimator.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The two factors of a LiveEstimator can change as well as the options of its type.
inline constexpr std::string_view odometry_factor = "odometry_sd_factor";
inline constexpr std::string_view observation_factor = "observation_sd_factor";

/// From the first event after `at` on, an option of an estimator has this value.
struct OptionChange {
  double at = 0.0;  // [s]
  std::string estimator;
  std::string option;
  double value = 0.0;
};

/// The changes among the faults of a world, in the order of time.
std::vector<OptionChange> option_changes(const worlds::World& world);

/// Why this estimator's option cannot get this value while it runs; nothing if it can. `choice` has the values
/// of all options.
std::optional<std::string> fault_of_change(const seif::Registry& registry,
                                           const worlds::EstimatorChoice& choice, const OptionChange& change);

/// Stores the new value in the options of a choice. fault_of_change() has found nothing.
void apply(const OptionChange& change, worlds::EstimatorChoice& choice);

/// Changes that are still to come. The work of an event without one is one comparison.
class OptionChanges {
 public:
  void add(const OptionChange& change);

  /// Makes the changes that are due before an event at `t` [s]. An estimator that refuses one fails, as it does
  /// if a step of it throws.
  void apply_before(double t, std::vector<LiveEstimator>& estimators);

 private:
  std::vector<OptionChange> changes_;  // in the order of time
  std::size_t next_ = 0;
};

}  // namespace harness
