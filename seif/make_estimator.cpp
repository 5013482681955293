#include "seif/make_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <variant>
#include <vector>

namespace seif {
namespace {

template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  text.precision(15);  // 1000000 and 0.1 as they are written
  text << std::boolalpha;
  (text << ... << parts);
  return text.str();
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string shown(const OptionValue& value) {
  return std::visit([](const auto& v) { return text_of(v); }, value);
}

std::optional<double> number_of(const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

/// Of the default, which every value must have.
std::string_view type_name(const OptionValue& fallback) {
  if (std::holds_alternative<bool>(fallback)) return "true or false";
  if (std::holds_alternative<std::int64_t>(fallback)) return "an integer";
  if (std::holds_alternative<double>(fallback)) return "a number";
  return "a text";
}

bool has_type_of(const OptionValue& fallback, const OptionValue& value) {
  return value.index() == fallback.index() ||
         (std::holds_alternative<double>(fallback) && std::holds_alternative<std::int64_t>(value));
}

std::string range_of(const OptionSpec& spec) {
  if (std::isinf(spec.max)) return text_of("at least ", spec.min);
  if (std::isinf(spec.min)) return text_of("at most ", spec.max);
  return text_of("at least ", spec.min, " and at most ", spec.max);
}

const OptionSpec& spec_of(const EstimatorType& type, const std::string& key) {
  const auto it = std::ranges::find(type.options, key, &OptionSpec::key);
  if (it != type.options.end()) return *it;
  std::vector<std::string> keys;
  for (const OptionSpec& spec : type.options) keys.push_back(spec.key);
  throw std::invalid_argument(type.name + " has no option '" + key +
                              (keys.empty() ? "'; it has none" : "'; it has " + listed(keys)));
}

[[noreturn]] void refuse(const EstimatorType& type, const std::string& fault) {
  throw std::invalid_argument(type.name + ": " + fault);
}

}  // namespace

std::optional<std::string> fault_of(const OptionSpec& spec, const OptionValue& value) {
  if (!has_type_of(spec.fallback, value))
    return text_of("'", spec.key, "' must be ", type_name(spec.fallback), ", not ", shown(value));
  if (const std::optional<double> number = number_of(value)) {
    if (!std::isfinite(*number)) return text_of("'", spec.key, "' must be finite, not ", *number);
    if (*number < spec.min || *number > spec.max)
      return text_of("'", spec.key, "' must be ", range_of(spec), ", not ", *number);
  }
  const auto* word = std::get_if<std::string>(&value);
  if (word == nullptr || spec.choices.empty()) return std::nullopt;
  if (std::ranges::find(spec.choices, *word) != spec.choices.end()) return std::nullopt;
  return text_of("'", spec.key, "' must be one of ", listed(spec.choices), ", not '", *word, "'");
}

std::optional<std::string> fault_of_order(const OptionSpec& spec, const Options& options) {
  if (spec.not_above.empty()) return std::nullopt;
  const double value = number_of(options.at(spec.key)).value();
  const double bound = number_of(options.at(spec.not_above)).value();
  if (value <= bound) return std::nullopt;
  return text_of("'", spec.key, "' must be at most '", spec.not_above, "', which is ", bound, ", not ", value,
                 "; set both");
}

Options complete_options(const EstimatorType& type, const Options& chosen) {
  Options all;
  for (const OptionSpec& spec : type.options) all[spec.key] = spec.fallback;
  for (const auto& [key, value] : chosen) {
    const OptionSpec& spec = spec_of(type, key);
    if (const auto fault = fault_of(spec, value)) refuse(type, *fault);
    all[key] = std::holds_alternative<double>(spec.fallback) ? OptionValue(*number_of(value)) : value;
  }
  for (const OptionSpec& spec : type.options) {
    if (const auto fault = fault_of_order(spec, all)) refuse(type, *fault);
  }
  return all;
}

std::unique_ptr<Estimator> make_estimator(const Registry& registry, std::string_view name,
                                          const EstimatorSetup& setup, const Options& chosen) {
  const EstimatorType* type = registry.find(name);
  if (type == nullptr) {
    std::vector<std::string> names;
    for (const EstimatorType& known : registry.types()) names.push_back(known.name);
    throw std::invalid_argument(text_of("there is no estimator '", name, "'; there are ", listed(names)));
  }
  return type->make(setup, complete_options(*type, chosen));
}

}  // namespace seif
