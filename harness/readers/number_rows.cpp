#include "harness/readers/number_rows.hpp"

#include <fmt/format.h>

namespace harness {

bool next_row(RowReader& rows, std::size_t cells) {
  do {
    if (!rows.next()) return false;
  } while (rows.is_comment() || rows.size() == 0);
  if (rows.size() > cells)
    rows.fail(cells, fmt::format("the row has {} values, there are {} columns", rows.size(), cells));
  return true;
}

}  // namespace harness
