#include "harness/run/without_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "harness/estimators/plugins.hpp"
#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

bool needs_names(const seif::EstimatorType& type, const worlds::EstimatorChoice& choice,
                 const LogDescription& log) {
  return type.make({log.start, log.T_robot_sensor, {}}, choice.options)->needs_names();
}

/// The option by which a type does without names; null if it has none.
const seif::OptionSpec* option_without_names(const seif::EstimatorType& type) {
  const auto spec = std::ranges::find_if(
      type.options, [](const seif::OptionSpec& option) { return option.without_names.has_value(); });
  return spec == type.options.end() ? nullptr : &*spec;
}

std::string text_of(const seif::OptionValue& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

/// The names of the types that can run without names by an option of theirs.
std::vector<std::string> types_without_names(const seif::Registry& registry) {
  std::vector<std::string> names;
  for (const seif::EstimatorType& type : registry.types()) {
    if (option_without_names(type) != nullptr) names.push_back(type.name);
  }
  return names;
}

}  // namespace

AbleEstimators able_estimators(const seif::Registry& registry,
                               std::span<const worlds::EstimatorChoice> choices, const LogDescription& log) {
  AbleEstimators able;
  for (worlds::EstimatorChoice choice : choices) {
    const seif::EstimatorType& type = type_of(registry, choice);
    if (!log.known_association && needs_names(type, choice, log)) {
      const seif::OptionSpec* option = option_without_names(type);
      if (option == nullptr) {
        able.notes.push_back(
            fmt::format("{} was left out: the observations do not name their landmarks", choice.name));
        continue;
      }
      choice.options[option->key] = *option->without_names;
      able.notes.push_back(
          fmt::format("{} ran with {}: {}, because the observations do not name their landmarks", choice.name,
                      option->key, text_of(*option->without_names)));
    }
    able.choices.push_back(std::move(choice));
  }
  return able;
}

AbleEstimators some_able_estimators(const seif::Registry& registry,
                                    std::span<const worlds::EstimatorChoice> choices,
                                    const LogDescription& log, const Remedy& remedy) {
  AbleEstimators able = able_estimators(registry, choices, log);
  if (able.choices.empty() && !able.notes.empty())
    throw BadInput(fmt::format(
        "{}: the observations do not say which landmark they are of, and no estimator here can do "
        "without that; type {}",
        log.name, remedy(types_without_names(registry))));
  return able;
}

AbleEstimators some_able_estimators(const seif::Registry& registry, const worlds::World& world,
                                    const LogDescription& log) {
  return some_able_estimators(registry, world.estimators, log, [](const std::vector<std::string>& types) {
    return fmt::format("--set 'estimators={{{}: {{}}}}'", fmt::join(types, ": {}, "));
  });
}

void check_steering(const worlds::World& world, const AbleEstimators& able) {
  const std::string& name = world.drive.pose_from;
  if (name != "truth" && name != "odometry" &&
      std::ranges::find(able.choices, name, &worlds::EstimatorChoice::name) == able.choices.end())
    throw BadInput(fmt::format(
        "drive.pose_from: {} cannot steer: the observations do not name their landmarks, and it needs that",
        name));
}

}  // namespace harness
