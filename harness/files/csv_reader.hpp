// Reads text tables row by row, strictly: every error names file, line, column and reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/files/row_reader.hpp"

namespace harness {

/// The columns of a table in their order: required ones, a group that is complete or absent, and after it a group
/// that older versions did not write.
struct Columns {
  std::vector<std::string> required;
  std::vector<std::string> optional;
  std::vector<std::string> newer = {};
};

/// A table as a stream of rows, in constant memory. All functions throw BadInput.
class CsvReader {
 public:
  CsvReader(std::filesystem::path path, Columns columns);

  /// A table without a header whose cells stand between spaces, as in TUM files; lines that begin with # are
  /// skipped.
  static CsvReader without_header(std::filesystem::path path, Columns columns);

  /// The next row; false at the end. A row may stop early: the cells that it lacks are empty.
  bool next();

  bool has_optional() const { return has_optional_; }
  bool has_newer() const { return has_newer_; }
  bool is_empty(int column) const;
  double number(int column) const;                                             // finite
  std::int64_t integer(int column, std::int64_t min, std::int64_t max) const;  // min <= value <= max
  [[noreturn]] void fail(int column, const std::string& reason) const;

 private:
  CsvReader(std::filesystem::path path, Columns columns, char separator);
  void read_header();
  const std::string& name(int column) const;

  RowReader rows_;
  Columns columns_;
  bool skips_comments_;
  bool has_optional_ = false;
  bool has_newer_ = false;
};

}  // namespace harness
