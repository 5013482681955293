#include "harness/files/row_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "harness/files/input_file.hpp"

namespace harness {

namespace {

constexpr std::size_t longest_line = 4096;  // [byte] far longer than any row of numbers

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // some editors begin UTF-8 files with it

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

RowReader::RowReader(std::filesystem::path path, char separator)
    : path_(std::move(path)), separator_(separator), file_(open_input(path_)) {
  line_.reserve(longest_line);
}

bool RowReader::read_line() {
  line_.clear();
  ++line_number_;
  has_line_end_ = true;
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
  has_line_end_ = false;
  return !line_.empty();
}

void RowReader::split() {
  const bool by_spaces = separator_ == ' ';
  const auto separates = [&](char c) { return c == separator_ || (by_spaces && c == '\t'); };
  cells_.clear();
  std::size_t begin = 0;
  while (begin <= line_.size()) {
    std::size_t end = begin;
    while (end < line_.size() && !separates(line_[end])) ++end;
    std::size_t first = begin;
    std::size_t last = end;
    while (first < last && is_blank(line_[first])) ++first;
    while (last > first && is_blank(line_[last - 1])) --last;
    const bool is_run_of_spaces = by_spaces && first == last;
    if (!is_run_of_spaces) cells_.push_back({first, last - first});
    begin = end + 1;
  }
}

bool RowReader::next() {
  if (!read_line()) return false;
  if (line_number_ == 1 && line_.starts_with(byte_order_mark)) line_.erase(0, byte_order_mark.size());
  split();
  return true;
}

std::string_view RowReader::cell(std::size_t i) const {
  if (i >= cells_.size()) return {};
  return std::string_view(line_).substr(cells_[i].begin, cells_[i].size);
}

double RowReader::number(std::size_t i, std::string_view name, Finite finite) const {
  const std::string_view text = cell(i);
  if (text.empty()) fail(i, fmt::format("{}: is missing", name));
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    fail(i, fmt::format("{}: '{}' is beyond the range of numbers", name, text));
  if (error != std::errc{} || end != text.data() + text.size())
    fail(i, fmt::format("{}: '{}' is not a number", name, text));
  if (finite == Finite::required && !std::isfinite(value))
    fail(i, fmt::format("{}: '{}' is not finite", name, text));
  return value;
}

std::int64_t RowReader::integer(std::size_t i, std::string_view name, std::int64_t min,
                                std::int64_t max) const {
  const std::string_view text = cell(i);
  if (text.empty()) fail(i, fmt::format("{}: is missing", name));
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < min || value > max)
    fail(i, fmt::format("{}: '{}' is not a whole number from {} to {}", name, text, min, max));
  return value;
}

void RowReader::fail(std::size_t i, const std::string& reason) const {
  const std::size_t position = i < cells_.size() ? cells_[i].begin + 1 : line_.size() + 1;
  throw BadInput(fmt::format("{}:{}:{}: {}", path_.string(), line_number_, position, reason));
}

}  // namespace harness
