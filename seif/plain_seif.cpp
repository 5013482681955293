#include "seif/plain_seif.hpp"

#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "seif/measurement_update.hpp"

namespace seif {

PlainSeif::PlainSeif(const EstimatorSetup& setup, const PlainSeifOptions& options)
    : InformationFilter(setup), options_(options), random_(setup.random) {
  if (options_.mean_recovery != MeanRecovery::coordinate_descent &&
      options_.mean_recovery != MeanRecovery::exact) {
    throw std::invalid_argument("mean_recovery: coordinate_descent or exact");
  }
  state_.track_residual();
}

void PlainSeif::measurement_update(const Scan& scan, const StageDone& done) {
  seif::measurement_update(state_, scan.observations, T_robot_sensor_);
  done(Stage::measurement);

  choose_surplus(state_,
                 {.theta_x = options_.theta_x,
                  .theta_max = options_.theta_max,
                  .order = options_.drop,
                  .keep_in_view = options_.keep_in_view},
                 to_drop_);
  if (!to_drop_.empty()) {
    const std::optional<double> anchoring = sparsify(state_, options_.rule, to_drop_);
    if (!anchoring) throw NumericalFailure("sparsification", scan.t);
    anchoring_ += *anchoring;
  }
  done(Stage::sparsification);

  const bool recovered = options_.mean_recovery == MeanRecovery::exact
                             ? solve_mean(state_)
                             : coordinate_descent(state_, options_.random_landmarks, random_);
  if (!recovered) throw NumericalFailure("mean recovery", scan.t);
  done(Stage::mean_recovery);
}

bool PlainSeif::change_option(std::string_view option, double value) {
  int* changed = option == "theta_x"     ? &options_.theta_x
                 : option == "theta_max" ? &options_.theta_max
                 : option == "K"         ? &options_.random_landmarks
                                         : nullptr;
  if (changed == nullptr) return false;
  *changed = static_cast<int>(value);
  return true;
}

Counts PlainSeif::counts() const {
  return {.blocks_touched = state_.blocks_touched(),
          .active_landmarks = state_.active_count(),
          .links = state_.link_count(),
          .mean_residual = state_.squared_residual(),
          .anchoring = anchoring_};
}

}  // namespace seif
