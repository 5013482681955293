#include "harness/files/csv_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace harness {

CsvReader::CsvReader(std::filesystem::path path, Columns columns, char separator)
    : rows_(std::move(path), separator), columns_(std::move(columns)), skips_comments_(separator == ' ') {}

CsvReader::CsvReader(std::filesystem::path path, Columns columns)
    : CsvReader(std::move(path), std::move(columns), ',') {
  read_header();
}

CsvReader CsvReader::without_header(std::filesystem::path path, Columns columns) {
  CsvReader reader(std::move(path), std::move(columns), ' ');
  reader.has_optional_ = !reader.columns_.optional.empty();
  return reader;
}

void CsvReader::read_header() {
  std::vector<std::string> all = columns_.required;
  all.insert(all.end(), columns_.optional.begin(), columns_.optional.end());
  const std::string wanted = fmt::format("{}", fmt::join(all, ","));
  if (!rows_.next())
    throw BadInput(fmt::format("{}:1:1: is empty; the first line must be {}", rows_.path().string(), wanted));
  check_line_end();
  const auto matches = [&](const std::vector<std::string>& names) {
    if (rows_.size() != names.size()) return false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (rows_.cell(i) != names[i]) return false;
    }
    return true;
  };
  std::vector<std::string> newest = all;
  newest.insert(newest.end(), columns_.newer.begin(), columns_.newer.end());
  has_newer_ = !columns_.newer.empty() && matches(newest);
  has_optional_ = has_newer_ || (!columns_.optional.empty() && matches(all));
  if (has_optional_ || matches(columns_.required)) return;
  std::size_t wrong = 0;
  while (wrong < rows_.size() && wrong < all.size() && rows_.cell(wrong) == all[wrong]) ++wrong;
  const std::string left_out = columns_.optional.empty() ? ""
                                                         : fmt::format(" ({} may be left out together)",
                                                                       fmt::join(columns_.optional, ", "));
  rows_.fail(wrong, fmt::format("wrong header; the first line must be {}{}", wanted, left_out));
}

bool CsvReader::next() {
  do {
    if (!rows_.next()) return false;
  } while (skips_comments_ && rows_.is_comment());
  check_line_end();
  const std::size_t most = columns_.required.size() + (has_optional_ ? columns_.optional.size() : 0) +
                           (has_newer_ ? columns_.newer.size() : 0);
  if (rows_.size() > most)
    rows_.fail(most, fmt::format("the row has {} values, there are {} columns", rows_.size(), most));
  return true;
}

/// A file that was cut within its last number would give another number.
void CsvReader::check_line_end() const {
  if (!rows_.has_line_end()) rows_.fail(rows_.size(), "the last line has no line end: the file may be cut");
}

const std::string& CsvReader::name(int column) const {
  const auto i = static_cast<std::size_t>(column);
  const std::size_t required = columns_.required.size();
  if (i < required) return columns_.required[i];
  const std::size_t optional = columns_.optional.size();
  return i < required + optional ? columns_.optional[i - required]
                                 : columns_.newer.at(i - required - optional);
}

bool CsvReader::is_empty(int column) const { return rows_.cell(static_cast<std::size_t>(column)).empty(); }

double CsvReader::number(int column) const {
  return rows_.number(static_cast<std::size_t>(column), name(column));
}

std::int64_t CsvReader::integer(int column, std::int64_t min, std::int64_t max) const {
  return rows_.integer(static_cast<std::size_t>(column), name(column), min, max);
}

std::string_view CsvReader::text(int column) const { return rows_.cell(static_cast<std::size_t>(column)); }

void CsvReader::fail(int column, const std::string& reason) const {
  rows_.fail(static_cast<std::size_t>(column), fmt::format("{}: {}", name(column), reason));
}

}  // namespace harness
