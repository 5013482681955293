// The cells of a sweep on disk. A file that exists is complete, whatever was killed and when.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/files/output_file.hpp"

namespace harness {

/// A file that gets its name in one step, when its contents are on the disk. Nobody ever finds a part of it,
/// even after a crash of the machine. Several processes, on several machines, may write the same file at
/// once. All functions throw std::system_error.
class DurableFile {
 public:
  explicit DurableFile(std::filesystem::path path);

  void append(std::string_view text) { file_.append(text); }
  void commit();

 private:
  std::filesystem::path path_;
  OutputFile file_;
};

/// Writes the whole text as a durable file.
void write_durable_file(const std::filesystem::path& path, std::string_view text);

/// Removes what killed writers of durable files have left in a folder.
void remove_unfinished_files(const std::filesystem::path& folder);

enum class CellState { open, failed, done };

/// A folder with one file for each cell that is done or failed. Several processes may write to it.
class CellFolder {
 public:
  explicit CellFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The states of all `count` cells, by index.
  std::vector<CellState> states(std::size_t count) const;

  /// The text of a cell that is done, or the reason why it failed.
  std::string result(std::size_t index) const;
  std::string failure(std::size_t index) const;

  /// A result replaces a failure.
  void put_result(std::size_t index, std::string_view text) const;
  void put_failure(std::size_t index, std::string_view reason) const;

 private:
  std::filesystem::path path(std::size_t index, const char* extension) const;

  std::filesystem::path folder_;
};

}  // namespace harness
