// Checks of what stands on the command line. A message says the option, what was written, and what is allowed.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace harness {

/// The largest seed, on the command line as in world files.
inline constexpr std::int64_t largest_seed = std::numeric_limits<std::int64_t>::max();

/// A whole number from `low` to `high`.
CLI::Validator whole_number(std::int64_t low, std::int64_t high = std::numeric_limits<std::int64_t>::max());

/// A seed, from 0 to largest_seed.
CLI::Validator seed_number();

/// A finite number.
CLI::Validator any_finite_number();

/// A number from `low` to `high`.
CLI::Validator number_between(double low, double high);

/// A number that is more than 0 and at most `high`.
CLI::Validator positive_number(double high);

/// One of these words.
CLI::Validator one_of(const std::vector<std::string>& choices);

}  // namespace harness
