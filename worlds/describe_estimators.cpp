#include "worlds/describe_estimators.hpp"

#include <fmt/format.h>

#include <exception>
#include <map>
#include <string>
#include <utility>

#include "worlds/suggestion.hpp"

namespace worlds {
namespace {

/// The types of the library that the estimator names. A library that cannot be loaded is a problem, and has none.
EstimatorTypes types_of_library(Fields& fields, const EstimatorChoice& choice,
                                const EstimatorSchemas& schemas) {
  try {
    if (schemas.of_library) return schemas.of_library(choice.library);
    fields.problem("library", "a library cannot be named here");
  } catch (const std::exception& error) {
    fields.problem("library", error.what());
  }
  fields.accept_unknown_keys();  // they may be options of its estimators
  return {};
}

/// The type that an estimator has if it names none: that of its own name, or the only one of its library. Empty:
/// it must name one.
std::string default_type(const EstimatorChoice& choice, const EstimatorTypes& types) {
  if (types.contains(choice.name)) return choice.name;
  return !choice.library.empty() && types.size() == 1 ? types.begin()->first : "";
}

void describe_estimator(Fields& fields, EstimatorChoice& choice, const EstimatorSchemas& schemas) {
  fields.text("library", choice.library,
              "shared library that has the type (a plug-in); its path is relative to this file",
              Need::optional);
  const EstimatorTypes known =
      choice.library.empty() ? schemas.types : types_of_library(fields, choice, schemas);
  std::vector<Fields::Case> cases;
  std::vector<std::string> types;
  for (const auto& [type, describe] : known) {
    types.push_back(type);
    cases.push_back({type, "", [&](Fields& inner) {
                       std::map<std::string, OptionValue> options;
                       describe(inner, options);
                       if (choice.type == type) choice.options = std::move(options);
                     }});
  }
  choice.type = default_type(choice, known);
  const bool needs_type = choice.type.empty() && !known.empty();
  fields.variant("type", choice.type, cases, "kind of estimator; by default its name",
                 needs_type ? Need::required : Need::defaulted);
  fields.number("odometry_sd_factor", choice.odometry_sd_factor,
                between(1 / largest_sd_factor, largest_sd_factor),
                "odometry noise that the filter assumes, over that of the sensor");
  fields.number("observation_sd_factor", choice.observation_sd_factor,
                between(1 / largest_sd_factor, largest_sd_factor),
                "observation noise that the filter assumes, over that of the sensor");
  const std::string hint = suggestion(choice.name, types);
  if (needs_type && choice.type.empty() && !hint.empty()) {
    fields.problem("", fmt::format("'{}' is no type of estimator{}", choice.name, hint));
  }
}

}  // namespace

void describe_estimators(Fields& fields, std::vector<EstimatorChoice>& choices,
                         const EstimatorSchemas& schemas, std::string_view help) {
  NameRule rule{{"truth", "odometry"}, {}};
  for (const auto& [type, describe] : schemas.types) rule.known.push_back(type);
  fields.named("estimators", rule, help, [&](Fields& inner, const std::string& name) {
    EstimatorChoice choice;
    choice.name = name;
    describe_estimator(inner, choice, schemas);
    choices.push_back(std::move(choice));
  });
}

}  // namespace worlds
