// Files that never lose an error of writing, and functions that read or write a whole file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace harness {

/// A file that only grows. Every failure (disk full, file deleted) throws std::system_error with the name of
/// the file.
class OutputFile {
 public:
  /// Creates the file. It must not exist.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();  // closes; data that flush() failed to write is lost, so call close() if this matters
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  void append(std::string_view text);

  /// Hands all data to the operating system. If this fails, the file ends with a complete line, and the
  /// unwritten data is lost.
  void flush();
  /// As flush(), and waits until the data is on the disk.
  void sync();
  void close();

  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail(int error) const;
  void keep_whole_lines(std::string_view written);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string buffer_;
  std::int64_t size_ = 0;  // [byte] flushed so far
};

/// What may happen to a regular file that has the name of an output.
enum class Existing { keep, replace };

/// Throws BadInput if an output may not have this name: it is that of a device, a pipe, a folder or a link,
/// which nothing ever replaces, or that of a regular file that is to be kept. An output that takes long calls
/// this before it begins.
void check_output(const std::filesystem::path& path, Existing existing);

/// Gives a finished file its name, under the rule of check_output. Throws std::system_error too.
void rename_output(const std::filesystem::path& unfinished, const std::filesystem::path& path,
                   Existing existing);

/// The name that a file has until it is whole.
std::filesystem::path unfinished_name(const std::filesystem::path& path);

/// Writes the whole text, under the rule of check_output. Nobody ever finds a part of the file under its name,
/// even after a power failure. Throws std::system_error too.
void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      Existing existing = Existing::replace);

/// Reads an existing file, as open_input does. Throws BadInput or std::system_error.
std::string read_whole_file(const std::filesystem::path& path);

}  // namespace harness
