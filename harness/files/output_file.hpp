// Output files on which every error is noticed, and files read or written as a whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace harness {

/// A file that only grows. Every failure (disk full, file gone) throws std::system_error that names the file.
class OutputFile {
 public:
  /// Creates the file; one that exists already is an error.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();  // closes; what a failed flush() left is lost, so call close() where it matters
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  void append(std::string_view text);

  /// Hands everything to the operating system. Where that fails, no part of a line is left in the file, and
  /// what was not written is lost.
  void flush();
  /// The same, and waits until it is on the disk.
  void sync();
  void close();

  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail(int error) const;
  void keep_whole_lines(std::string_view written);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string buffer_;
  std::int64_t size_ = 0;  // [byte] of what was flushed
};

/// Writes the whole text. No reader finds a part of the file under its name, even after a power failure.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// Reads an existing file. Throws std::system_error.
std::string read_whole_file(const std::filesystem::path& path);

}  // namespace harness
