// Reads text tables row by row, strictly. Every error message has file, line, column and reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/files/row_reader.hpp"

namespace harness {

/// The columns of a table, in this order: required ones, a group that may follow, and a second group that may
/// follow the first. The second group is missing in files of older versions.
struct Columns {
  std::vector<std::string> required;
  std::vector<std::string> optional;
  std::vector<std::string> newer = {};
};

/// A table as a stream of rows, in constant memory. A file whose last line has no end is refused. All functions
/// throw BadInput.
class CsvReader {
 public:
  CsvReader(std::filesystem::path path, Columns columns);

  /// Opens a table without a header, with spaces between the cells, as in TUM files. Lines that begin with #
  /// are skipped.
  static CsvReader without_header(std::filesystem::path path, Columns columns);

  /// Reads the next row; false at the end. A row may be short: its missing cells are empty.
  bool next();

  bool has_optional() const { return has_optional_; }
  bool has_newer() const { return has_newer_; }
  bool is_empty(int column) const;
  double number(int column) const;                                             // finite
  std::int64_t integer(int column, std::int64_t min, std::int64_t max) const;  // min <= value <= max
  std::string_view text(int column) const;                                     // until the next row
  [[noreturn]] void fail(int column, const std::string& reason) const;

 private:
  CsvReader(std::filesystem::path path, Columns columns, char separator);
  void read_header();
  void check_line_end() const;
  const std::string& name(int column) const;

  RowReader rows_;
  Columns columns_;
  bool skips_comments_;
  bool has_optional_ = false;
  bool has_newer_ = false;
};

}  // namespace harness
