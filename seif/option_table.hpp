// The options of an estimator. Each is described in one place: its member in the options struct, its key, its
// range, its help text. The defaults are those of the struct.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "seif/registry.hpp"

namespace seif {

/// The inclusive range of a number.
struct OptionRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// The words that a world file may use for the values of an enumeration.
template <class Enum>
using OptionChoices = std::vector<std::pair<std::string, Enum>>;

/// Describes the options of a Struct, and reads them. `field` is always a function that returns the member of a
/// Struct& by reference: `[](SeifOptions& o) -> int& { return o.theta_x; }`.
template <class Struct>
class OptionTable {
 public:
  explicit OptionTable(Struct defaults = {}) : defaults_(std::move(defaults)) {}

  /// An int or double.
  template <class Field>
  OptionTable& number(std::string key, Field field, const OptionRange& range, std::string help) {
    using Number = std::remove_reference_t<std::invoke_result_t<Field, Struct&>>;
    using Stored = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;
    specs_.push_back({.key = key,
                      .fallback = static_cast<Stored>(field(defaults_)),
                      .min = range.min,
                      .max = range.max,
                      .help = std::move(help)});
    setters_.push_back([field, key = std::move(key)](Struct& to, const Options& from) {
      field(to) = static_cast<Number>(option<Stored>(from, key));
    });
    return *this;
  }

  /// The number that was described last may not be larger than that of the option `key`.
  OptionTable& not_above(std::string key) {
    specs_.back().not_above = std::move(key);
    return *this;
  }

  /// A value of an enumeration; the default must be among the choices.
  template <class Field, class Enum>
  OptionTable& choice(std::string key, Field field, const OptionChoices<Enum>& choices, std::string help) {
    OptionSpec spec{.key = key, .fallback = std::string(), .help = std::move(help)};
    for (const auto& [word, value] : choices) {
      spec.choices.push_back(word);
      if (value == field(defaults_)) spec.fallback = word;
    }
    specs_.push_back(std::move(spec));
    setters_.push_back([field, choices, key = std::move(key)](Struct& to, const Options& from) {
      for (const auto& [word, value] : choices) {
        if (word == option<std::string>(from, key)) field(to) = value;
      }
    });
    return *this;
  }

  /// With this value of the option that was described last, observations need not name their landmarks.
  OptionTable& without_names(std::string value) {
    specs_.back().without_names = std::move(value);
    return *this;
  }

  /// The filter can change the number that was described last while it runs.
  OptionTable& changeable() {
    specs_.back().changeable = true;
    return *this;
  }

  const std::vector<OptionSpec>& specs() const { return specs_; }

  /// `options` holds a value of the right type for every key.
  Struct read(const Options& options) const {
    Struct chosen = defaults_;
    for (const auto& set : setters_) set(chosen, options);
    return chosen;
  }

 private:
  Struct defaults_;
  std::vector<OptionSpec> specs_;
  std::vector<std::function<void(Struct&, const Options&)>> setters_;
};

}  // namespace seif
