#include "harness/files/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace harness {

std::string text_table(const std::vector<TextRow>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const TextRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const TextRow& row : rows) {
    text += fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    text += '\n';
  }
  return text;
}

std::string number_cell(const std::optional<double>& value, int decimals) {
  if (!value) return "-";
  return *value < 1e6 ? fmt::format("{:.{}f}", *value, decimals) : fmt::format("{:.1e}", *value);
}

}  // namespace harness
