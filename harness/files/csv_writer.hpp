// Writes text tables during a run, in bounded memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "harness/files/output_file.hpp"

namespace harness {

/// The text as a cell of a table, in quotes if it needs them (RFC 4180).
std::string csv_cell(std::string_view text);

/// Writes rows of values. Numbers read back have the same bits.
class CsvWriter {
 public:
  /// `header` is the first line, without its line end. A TUM file has a space as separator and no header.
  explicit CsvWriter(std::filesystem::path path, std::string_view header, char separator = ',');

  CsvWriter& value(double number);
  CsvWriter& value(std::int64_t number);
  /// A cell that needs no quotes.
  CsvWriter& text(std::string_view cell);
  CsvWriter& leave_empty(int cells = 1);
  void end_row();

  void flush() { file_.flush(); }
  void close() { file_.close(); }

 private:
  void separate();

  OutputFile file_;
  char separator_;
  bool row_begun_ = false;
  std::string row_;
};

}  // namespace harness
