#include "harness/estimators/estimator_schemas.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "harness/estimators/plugins.hpp"
#include "seif/make_estimator.hpp"

namespace harness {

namespace {

/// Describes one option; its value is stored in `value`.
class DescribeOption {
 public:
  DescribeOption(worlds::Fields& fields, const seif::OptionSpec& spec, worlds::OptionValue& value)
      : fields_(fields), spec_(spec), value_(value) {}

  void operator()(bool value) {
    fields_.boolean(spec_.key, value, spec_.help);
    value_ = value;
  }
  void operator()(std::int64_t value) {
    fields_.integer(spec_.key, value, range(), spec_.help);
    value_ = value;
  }
  void operator()(double value) {
    fields_.number(spec_.key, value, range(), spec_.help);
    value_ = value;
  }
  void operator()(std::string value) {
    if (spec_.choices.empty()) {
      fields_.text(spec_.key, value, spec_.help);
    } else {
      fields_.choice(spec_.key, value, spec_.choices, spec_.help);
    }
    value_ = std::move(value);
  }

 private:
  /// An option without a bound gets that of all numbers.
  worlds::Range range() const {
    return worlds::between(std::max(spec_.min, -worlds::largest_number),
                           std::min(spec_.max, worlds::largest_number));
  }

  worlds::Fields& fields_;
  const seif::OptionSpec& spec_;
  worlds::OptionValue& value_;
};

/// Refuses a number that is larger than the option that bounds it.
void check_order(worlds::Fields& fields, const std::vector<seif::OptionSpec>& specs,
                 const seif::Options& options) {
  for (const seif::OptionSpec& spec : specs) {
    if (const auto fault = seif::fault_of_order(spec, options)) fields.problem(spec.key, *fault);
  }
}

worlds::EstimatorTypes types_of(const seif::Registry& registry) {
  worlds::EstimatorTypes types;
  for (const seif::EstimatorType& type : registry.types()) {
    types[type.name] = [specs = type.options](worlds::Fields& fields,
                                              std::map<std::string, worlds::OptionValue>& options) {
      for (const seif::OptionSpec& spec : specs) {
        std::visit(DescribeOption(fields, spec, options[spec.key]), spec.fallback);
      }
      if (fields.sound()) check_order(fields, specs, options);
    };
  }
  return types;
}

}  // namespace

worlds::EstimatorSchemas estimator_schemas(const seif::Registry& registry) {
  return {.types = types_of(registry),
          .of_library = [](const std::string& library) { return types_of(plugin_estimators(library)); }};
}

}  // namespace harness
