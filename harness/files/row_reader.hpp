// Reads a text file line by line, and each line cell by cell. Every error message has file, line, column and
// reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "harness/files/bad_input.hpp"

namespace harness {

/// Whether a number must be finite, or may be nan or inf.
enum class Finite { required, not_required };

/// A file as a stream of lines, in constant memory. All functions throw BadInput.
class RowReader {
 public:
  /// `separator` is between the cells. If it is a space, any number of spaces and tabs separates cells.
  RowReader(std::filesystem::path path, char separator);

  /// Reads the next line; false at the end.
  bool next();

  const std::filesystem::path& path() const { return path_; }
  std::int64_t line_number() const { return line_number_; }
  std::string_view line() const { return line_; }
  bool has_line_end() const { return has_line_end_; }  // false: the file ends within or right after the line
  bool is_comment() const { return line_.starts_with('#'); }

  std::size_t size() const { return cells_.size(); }  // number of cells
  std::string_view cell(std::size_t i) const;         // trimmed; empty if the line has no such cell

  /// The number in a cell; error messages call the cell `name`.
  double number(std::size_t i, std::string_view name, Finite finite = Finite::required) const;
  std::int64_t integer(std::size_t i, std::string_view name, std::int64_t min, std::int64_t max) const;
  [[noreturn]] void fail(std::size_t i, const std::string& reason) const;

 private:
  bool read_line();
  void split();

  struct Cell {
    std::size_t begin = 0;  // [-] offset in the line
    std::size_t size = 0;
  };

  std::filesystem::path path_;
  char separator_;
  std::ifstream file_;
  std::int64_t line_number_ = 0;
  bool has_line_end_ = true;
  std::string line_;
  std::vector<Cell> cells_;
};

}  // namespace harness
