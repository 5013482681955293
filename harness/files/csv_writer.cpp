#include "harness/files/csv_writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace harness {

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell.append(c == '"' ? 2 : 1, c);
  return cell + '"';
}

CsvWriter::CsvWriter(std::filesystem::path path, std::string_view header, char separator)
    : file_(std::move(path)), separator_(separator) {
  if (header.empty()) return;
  row_ = header;
  end_row();
  file_.flush();  // so that a killed run leaves no table without its head
}

void CsvWriter::separate() {
  if (row_begun_) row_ += separator_;
  row_begun_ = true;
}

CsvWriter& CsvWriter::value(double number) {
  separate();
  fmt::format_to(std::back_inserter(row_), "{}", number);
  return *this;
}

CsvWriter& CsvWriter::value(std::int64_t number) {
  separate();
  fmt::format_to(std::back_inserter(row_), "{}", number);
  return *this;
}

CsvWriter& CsvWriter::text(std::string_view cell) {
  separate();
  row_ += cell;
  return *this;
}

CsvWriter& CsvWriter::leave_empty(int cells) {
  for (int i = 0; i < cells; ++i) separate();
  return *this;
}

void CsvWriter::end_row() {
  row_ += '\n';
  file_.append(row_);
  row_.clear();
  row_begun_ = false;
}

}  // namespace harness
