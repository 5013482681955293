// Makes an estimator by its name, with options that are checked: how a program of its own gets a filter.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "seif/registry.hpp"

namespace seif {

/// What is wrong with the value of an option by itself; nothing if it is valid. An integer is also a number.
std::optional<std::string> fault_of(const OptionSpec& spec, const OptionValue& value);

/// What is wrong with an option that may not be above another one; nothing if it is not. `options` holds every
/// option of the type.
std::optional<std::string> fault_of_order(const OptionSpec& spec, const Options& options);

/// All options of a type: those chosen, and the defaults of the others. Throws std::invalid_argument for an option that
/// the type does not have, and for a value that is not valid.
Options complete_options(const EstimatorType& type, const Options& chosen);

/// Throws std::invalid_argument if the registry has no estimator of this name, and as complete_options() does. The filter
/// itself may refuse its setup.
std::unique_ptr<Estimator> make_estimator(const Registry& registry, std::string_view name,
                                          const EstimatorSetup& setup, const Options& chosen = {});

}  // namespace seif
