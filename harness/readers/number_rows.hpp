// Tables of numbers with a time column, from robots that sometimes write invalid values.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "harness/files/row_reader.hpp"
#include "harness/readers/velocity_log.hpp"

namespace harness {

/// The next line that is neither a comment nor empty, with at most `cells` cells.
bool next_row(RowReader& rows, std::size_t cells);

/// The next row of finite numbers whose time, in column `Time`, does not go back. Other rows are left out and
/// counted. Throws BadInput for a cell that is not a number.
template <std::size_t Time = 0, std::size_t Columns>
std::optional<std::array<double, Columns>> next_numbers(RowReader& rows,
                                                        const std::array<std::string_view, Columns>& names,
                                                        std::optional<double>& last_t, ReadCounts& counts) {
  while (next_row(rows, Columns)) {
    std::array<double, Columns> values;
    for (std::size_t i = 0; i < Columns; ++i) values[i] = rows.number(i, names[i], Finite::not_required);
    if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
      ++counts.not_finite;
    } else if (last_t && values[Time] < *last_t) {
      ++counts.backwards;
    } else {
      last_t = values[Time];
      return values;
    }
  }
  return std::nullopt;
}

}  // namespace harness
