// The estimators by name, with their options. This one list is used to check world files and to make filters.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "seif/estimator.hpp"

namespace seif {

using OptionValue = std::variant<bool, std::int64_t, double, std::string>;
using Options = std::map<std::string, OptionValue>;

/// One option of an estimator. The type is that of its default.
struct OptionSpec {
  std::string key;
  OptionValue fallback;                                   // the default
  double min = -std::numeric_limits<double>::infinity();  // numbers only, inclusive
  double max = std::numeric_limits<double>::infinity();   // numbers only, inclusive
  std::string not_above = {};             // numbers only: an option of the same type that is no smaller
  std::vector<std::string> choices = {};  // strings only; empty: any
  std::optional<OptionValue> without_names = {};  // the value with which it does without landmarks' names
  bool changeable = false;  // numbers only: Estimator::change_option() can change it between two updates
  std::string help;         // one sentence, with the unit
};

/// A kind of estimator: its name, its options, and how it is made.
struct EstimatorType {
  std::string name;
  std::string help;  // one sentence
  std::vector<OptionSpec> options;
  /// `options` holds a value of the right type for every key in `options`.
  std::function<std::unique_ptr<Estimator>(const EstimatorSetup&, const Options&)> make;
};

/// A list of estimator types with distinct names. To use a filter of your own in world files, add() it.
class Registry {
 public:
  /// Throws std::invalid_argument if the name is taken.
  void add(EstimatorType type);

  const std::vector<EstimatorType>& types() const { return types_; }

  /// Null if no estimator type has this name.
  const EstimatorType* find(std::string_view name) const;

 private:
  std::vector<EstimatorType> types_;
};

/// Every estimator that this library brings.
Registry standard_estimators();

/// The value of an option. Throws std::out_of_range if the option is missing, and std::bad_variant_access if it
/// has another type.
template <class T>
const T& option(const Options& options, const std::string& key) {
  return std::get<T>(options.at(key));
}

}  // namespace seif
