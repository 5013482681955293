#include "harness/run/option_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <variant>

#include "harness/estimators/plugins.hpp"
#include "seif/make_estimator.hpp"

namespace harness {

namespace {

/// The factor of a choice or of a running estimator that an option stands for; null if it is another option.
template <class Estimator>
double* factor_of(Estimator& estimator, std::string_view option) {
  if (option == odometry_factor) return &estimator.odometry_sd_factor;
  return option == observation_factor ? &estimator.observation_sd_factor : nullptr;
}

/// The value with the type of the option.
seif::OptionValue typed(const seif::OptionValue& like, double value) {
  if (std::holds_alternative<std::int64_t>(like)) return std::llround(value);
  return value;
}

std::string changeable_options(const seif::EstimatorType& type) {
  std::string names = fmt::format("{}, {}", odometry_factor, observation_factor);
  for (const seif::OptionSpec& spec : type.options) {
    if (spec.changeable) names += ", " + spec.key;
  }
  return names;
}

}  // namespace

std::vector<OptionChange> option_changes(const worlds::World& world) {
  std::vector<OptionChange> changes;
  for (const worlds::Fault& fault : world.faults) {
    if (fault.kind == worlds::FaultKind::option)
      changes.push_back({fault.at, fault.estimator, fault.option, fault.option_value});
  }
  std::ranges::stable_sort(changes, {}, &OptionChange::at);
  return changes;
}

std::optional<std::string> fault_of_change(const seif::Registry& registry,
                                           const worlds::EstimatorChoice& choice,
                                           const OptionChange& change) {
  if (change.option == odometry_factor || change.option == observation_factor) {
    constexpr double most = worlds::largest_sd_factor;
    if (change.value >= 1.0 / most && change.value <= most) return std::nullopt;
    return fmt::format("'{}' must be from {} to {}, not {}", change.option, 1.0 / most, most, change.value);
  }
  const seif::EstimatorType& type = type_of(registry, choice);
  const auto spec = std::ranges::find(type.options, change.option, &seif::OptionSpec::key);
  if (spec == type.options.end() || !spec->changeable)
    return fmt::format("'{}' of {} cannot change during a run; these can: {}", change.option, choice.name,
                       changeable_options(type));
  if (std::holds_alternative<std::int64_t>(spec->fallback) && change.value != std::round(change.value))
    return fmt::format("'{}' must be a whole number, not {}", change.option, change.value);
  const seif::OptionValue value = typed(spec->fallback, change.value);
  if (auto fault = seif::fault_of(*spec, value)) return fault;
  seif::Options options = choice.options;
  options[change.option] = value;
  for (const seif::OptionSpec& other : type.options) {
    if (auto fault = seif::fault_of_order(other, options)) return fault;
  }
  return std::nullopt;
}

void apply(const OptionChange& change, worlds::EstimatorChoice& choice) {
  if (double* factor = factor_of(choice, change.option)) {
    *factor = change.value;
  } else {
    seif::OptionValue& value = choice.options.at(change.option);
    value = typed(value, change.value);
  }
}

void OptionChanges::add(const OptionChange& change) {
  changes_.insert(std::ranges::upper_bound(changes_, change.at, {}, &OptionChange::at), change);
}

void OptionChanges::apply_before(double t, std::vector<LiveEstimator>& estimators) {
  for (; next_ < changes_.size() && changes_[next_].at < t; ++next_) {
    const OptionChange& change = changes_[next_];
    const auto estimator = std::ranges::find(estimators, change.estimator, &LiveEstimator::name);
    if (estimator == estimators.end() || !estimator->failure.empty()) continue;
    if (double* factor = factor_of(*estimator, change.option)) {
      *factor = change.value;
    } else if (!estimator->filter->change_option(change.option, change.value)) {
      estimator->failure =
          fmt::format("at {} s: it cannot change its option '{}' while it runs", change.at, change.option);
    }
  }
}

}  // namespace harness
