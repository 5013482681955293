#include "harness/csv_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace harness {

namespace {

constexpr std::size_t longest_line = 4096;  // [byte] no row of numbers comes near it

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

CsvReader::CsvReader(std::filesystem::path path, Columns columns, char separator)
    : path_(std::move(path)), columns_(std::move(columns)), separator_(separator), file_(path_) {
  std::error_code error;
  if (!file_ || !std::filesystem::is_regular_file(path_, error))
    throw BadInput(fmt::format("{}: cannot be read", path_.string()));
  line_.reserve(longest_line);
}

CsvReader::CsvReader(std::filesystem::path path, Columns columns)
    : CsvReader(std::move(path), std::move(columns), ',') {
  read_header();
}

CsvReader CsvReader::without_header(std::filesystem::path path, Columns columns) {
  CsvReader reader(std::move(path), std::move(columns), ' ');
  reader.has_optional_ = !reader.columns_.optional.empty();
  return reader;
}

bool CsvReader::read_line() {
  line_.clear();
  ++line_number_;
  for (int c = file_.get(); c != std::ifstream::traits_type::eof(); c = file_.get()) {
    if (c == '\n') {
      if (!line_.empty() && line_.back() == '\r') line_.pop_back();
      return true;
    }
    if (line_.size() == longest_line)
      throw BadInput(fmt::format("{}:{}:1: the line is longer than {} bytes", path_.string(), line_number_,
                                 longest_line));
    line_ += static_cast<char>(c);
  }
  if (file_.bad())
    throw BadInput(fmt::format("{}:{}:1: cannot be read further", path_.string(), line_number_));
  return !line_.empty();
}

void CsvReader::split() {
  cells_.clear();
  std::size_t begin = 0;
  while (begin <= line_.size()) {
    const std::size_t end = std::min(line_.find(separator_, begin), line_.size());
    std::size_t first = begin;
    std::size_t last = end;
    while (first < last && is_blank(line_[first])) ++first;
    while (last > first && is_blank(line_[last - 1])) --last;
    const bool is_run_of_spaces = separator_ == ' ' && first == last;
    if (!is_run_of_spaces) cells_.push_back({first, last - first});
    begin = end + 1;
  }
}

void CsvReader::read_header() {
  std::vector<std::string> all = columns_.required;
  all.insert(all.end(), columns_.optional.begin(), columns_.optional.end());
  const std::string wanted = fmt::format("{}", fmt::join(all, ","));
  if (!read_line())
    throw BadInput(fmt::format("{}:1:1: is empty; the first line must be {}", path_.string(), wanted));
  split();
  const auto matches = [&](const std::vector<std::string>& names) {
    return std::ranges::equal(cells_, names, [&](const Cell& c, const std::string& column_name) {
      return std::string_view(line_).substr(c.begin, c.size) == column_name;
    });
  };
  has_optional_ = !columns_.optional.empty() && matches(all);
  if (has_optional_ || matches(columns_.required)) return;
  std::size_t wrong = 0;
  while (wrong < cells_.size() && wrong < all.size() && cell(static_cast<int>(wrong)) == all[wrong]) ++wrong;
  const std::size_t column = wrong < cells_.size() ? cells_[wrong].begin + 1 : line_.size() + 1;
  const std::string left_out = columns_.optional.empty() ? ""
                                                         : fmt::format(" ({} may be left out together)",
                                                                       fmt::join(columns_.optional, ", "));
  throw BadInput(fmt::format("{}:1:{}: wrong header; the first line must be {}{}", path_.string(), column,
                             wanted, left_out));
}

bool CsvReader::next() {
  do {
    if (!read_line()) return false;
  } while (separator_ == ' ' && line_.starts_with('#'));
  split();
  const std::size_t most = columns_.required.size() + (has_optional_ ? columns_.optional.size() : 0);
  if (cells_.size() > most) {
    throw BadInput(fmt::format("{}:{}:{}: the row has {} values, there are {} columns", path_.string(),
                               line_number_, cells_[most].begin + 1, cells_.size(), most));
  }
  return true;
}

std::string_view CsvReader::cell(int column) const {
  const auto i = static_cast<std::size_t>(column);
  if (i >= cells_.size()) return {};
  return std::string_view(line_).substr(cells_[i].begin, cells_[i].size);
}

const std::string& CsvReader::name(int column) const {
  const auto i = static_cast<std::size_t>(column);
  const std::size_t required = columns_.required.size();
  return i < required ? columns_.required[i] : columns_.optional.at(i - required);
}

bool CsvReader::is_empty(int column) const { return cell(column).empty(); }

double CsvReader::number(int column) const {
  const std::string_view text = cell(column);
  if (text.empty()) fail(column, "is missing");
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    fail(column, fmt::format("'{}' is beyond the range of numbers", text));
  if (error != std::errc{} || end != text.data() + text.size())
    fail(column, fmt::format("'{}' is not a number", text));
  if (!std::isfinite(value)) fail(column, fmt::format("'{}' is not finite", text));
  return value;
}

std::int64_t CsvReader::integer(int column, std::int64_t min, std::int64_t max) const {
  const std::string_view text = cell(column);
  if (text.empty()) fail(column, "is missing");
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < min || value > max)
    fail(column, fmt::format("'{}' is not a whole number from {} to {}", text, min, max));
  return value;
}

void CsvReader::fail(int column, const std::string& reason) const {
  const auto i = static_cast<std::size_t>(column);
  const std::size_t position = i < cells_.size() ? cells_[i].begin + 1 : line_.size() + 1;
  throw BadInput(
      fmt::format("{}:{}:{}: {}: {}", path_.string(), line_number_, position, name(column), reason));
}

}  // namespace harness
