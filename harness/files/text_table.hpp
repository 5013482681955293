// Tables as plain text.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace harness {

using TextRow = std::vector<std::string>;

/// Makes each column as wide as needed. The first column is left-aligned, the others right-aligned. All rows
/// have the same length.
std::string text_table(const std::vector<TextRow>& rows);

/// A number with this many decimals, or "-" if empty. A number that is too long for a column is written with
/// an exponent.
std::string number_cell(const std::optional<double>& value, int decimals);

}  // namespace harness
