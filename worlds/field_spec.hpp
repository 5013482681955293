// The description of one field: its key, its range, whether it may be missing.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace worlds {

/// No quantity of a world or a log is larger, in any unit. A larger number is a typing mistake, and its square
/// might not be finite. [-]
inline constexpr double largest_number = 1e12;

/// The bound of integers: 2^63, which itself is none of them. [-]
inline constexpr double beyond_integers = 9223372036854775808.0;

/// The numbers that are allowed, in the unit of the key. They must be finite, and so are both bounds.
struct Range {
  double min = -largest_number;
  double max = largest_number;
  bool excludes_min = false;
  double multiple_of = 0.0;  // [-] 0: any number
};

inline Range any_number() { return {}; }
inline Range at_least(double min) { return {.min = min}; }
inline Range more_than(double min) { return {.min = min, .excludes_min = true}; }
inline Range between(double min, double max) { return {.min = min, .max = max}; }
inline Range more_than_up_to(double min, double max) {
  return {.min = min, .max = max, .excludes_min = true};
}
inline Range even_between(double min, double max) { return {.min = min, .max = max, .multiple_of = 2}; }

/// What happens if a key is missing.
enum class Need {
  defaulted,  // the default is used, and the reader writes it into the document
  optional,   // the value stays as it is, and nothing is written
  required,   // it is a problem
};

/// The description of one value.
struct FieldSpec {
  std::string_view key;
  std::string_view help;
  Need need = Need::defaulted;
  Range range = {};                       // numbers
  std::vector<std::string> choices = {};  // texts; empty: any
  std::size_t min_count = 0;              // lists of points: the fewest points
  std::size_t max_count = 0;              // lists of names: the most names
};

/// Names are those of files, too: they are short, and not mistaken for an option. [-] characters
inline constexpr std::size_t longest_name = 64;

/// The names that a map of named things may use: at most longest_name letters, digits, '_' and '-', the first
/// of them not '-', except the reserved ones.
struct NameRule {
  std::vector<std::string> reserved;
  std::vector<std::string> known;  // names with a fixed meaning: the schema describes each of them
};

}  // namespace worlds
