#include "seif/eseif.hpp"

#include <algorithm>
#include <string_view>

#include "seif/mean_recovery.hpp"
#include "seif/measurement_update.hpp"
#include "seif/relocation.hpp"

namespace seif {

Eseif::Eseif(const EstimatorSetup& setup, const EseifOptions& options)
    : InformationFilter(setup), options_(options) {}

void Eseif::measurement_update(const Scan& scan, const StageDone& done) {
  now_ = scan.observations;
  held_back_.clear();
  if (overflows(scan)) hold_back(scan);
  seif::measurement_update(state_, now_, T_robot_sensor_);
  done(Stage::measurement);

  if (!held_back_.empty()) {
    solve(scan.t);  // gives the pose at which to linearise
    if (!marginalise_robot(state_)) throw NumericalFailure("relocation", scan.t);
    seif::measurement_update(state_, held_back_, T_robot_sensor_);
    ++relocations_;
  }
  done(Stage::sparsification);

  solve(scan.t);
  done(Stage::mean_recovery);
}

/// Whether the scan would give the robot too many links.
bool Eseif::overflows(const Scan& scan) const {
  int active = state_.active_count();
  for (const Observation& observation : scan.observations) {
    const auto slot = state_.find(observation.landmark);
    if (!slot || state_.position(*slot) < 0) ++active;
  }
  return active > options_.theta_x;
}

/// Splits the scan into now_ and held_back_. The latter gets observations of landmarks that are in the map,
/// spread over the bearings. It stays empty if the scan sees fewer than two of them: they would not determine
/// the pose.
void Eseif::hold_back(const Scan& scan) {
  known_.clear();
  for (const Observation& observation : scan.observations) {
    const bool is_known = state_.find(observation.landmark).has_value();
    const bool is_new =
        std::ranges::find(known_, observation.landmark, &Observation::landmark) == known_.end();
    if (is_known && is_new) known_.push_back(observation);
  }
  if (known_.size() < 2) return;
  std::ranges::sort(known_, {}, &Observation::bearing);
  const std::size_t count = std::min(known_.size(), static_cast<std::size_t>(options_.relocation_landmarks));
  for (std::size_t i = 0; i < count; ++i) held_back_.push_back(known_[i * known_.size() / count]);
  for (const Observation& observation : held_back_) {  // a landmark's further observations stay in now_
    now_.erase(std::ranges::find(now_, observation.landmark, &Observation::landmark));
  }
}

void Eseif::solve(double t) {
  if (!solve_mean(state_)) throw NumericalFailure("mean recovery", t);
}

bool Eseif::change_option(std::string_view option, double value) {
  if (option != "theta_x") return false;
  options_.theta_x = static_cast<int>(value);
  return true;
}

Counts Eseif::counts() const {
  return {.blocks_touched = state_.blocks_touched(),
          .relocations = relocations_,
          .active_landmarks = state_.active_count(),
          .links = state_.link_count()};
}

}  // namespace seif
