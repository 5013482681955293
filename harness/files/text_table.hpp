// Tables of text for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace harness {

using TextRow = std::vector<std::string>;

/// Columns as wide as they need, the first to the left and the others to the right. Rows of equal length.
std::string text_table(const std::vector<TextRow>& rows);

/// A cell with so many decimals, or "-"; what does not fit into a column is told by its magnitude.
std::string number_cell(const std::optional<double>& value, int decimals);

}  // namespace harness
