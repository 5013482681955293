// How long a header and a function may be, and how many private functions a class may have. Each check returns what
// is too large, as `path:line: what is wrong`.
#pragma once

#include "rules.hpp"
#include "source.hpp"

namespace rooms {

constexpr int longest_header = 150;         // [lines]
constexpr int longest_function = 50;        // [lines] from its opening to its closing brace
constexpr int most_private_functions = 30;  // [-] of a class

Findings check_header_length(const TextFile& file);

/// A function is recognised by its opening brace behind a parameter list, outside of any function.
Findings check_function_lengths(const Source& source);

/// Counts the declarations with a parameter list after `private:`.
Findings check_private_functions(const Source& source);

}  // namespace rooms
