// Tables of text for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace harness {

using TextRow = std::vector<std::string>;

/// Columns as wide as they need, the first to the left and the others to the right. Rows of equal length.
std::string text_table(const std::vector<TextRow>& rows);

/// A cell with this many decimals, or "-". Values that do not fit into a column are written in powers of ten.
std::string number_cell(const std::optional<double>& value, int decimals);

}  // namespace harness
