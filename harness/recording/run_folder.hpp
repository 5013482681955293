// The folder of a run: a second run never destroys a first.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace harness {

/// `name` with everything but letters, digits, '.', '_' and '-' replaced: fit to be one part of a path.
std::string file_name_of(std::string_view name);

/// Creates parent/name, or, if that exists, parent/name-2, parent/name-3, ...: the first unused one.
/// Two programs at the same time get two folders. Throws std::filesystem::filesystem_error.
std::filesystem::path create_run_folder(const std::filesystem::path& parent, const std::string& name);

/// Creates this very folder, or takes it if it is there and empty; otherwise throws BadInput.
std::filesystem::path create_empty_folder(const std::filesystem::path& folder);

/// folder/name, or, if that exists, the same with -2, -3, ... before its extension: the first unused one.
std::filesystem::path free_file(const std::filesystem::path& folder, const std::filesystem::path& name);

/// A temporary folder, removed with its content.
class TemporaryFolder {
 public:
  TemporaryFolder();  // throws std::system_error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A hash (16 hex digits) over the names and bytes of a run's measurements and estimates: truth.csv, odometry.csv,
/// observations.csv, all *.tum and all *_map.csv, in the order of their names (FNV-1a, 64 bits). Equal for a
/// run and its repetition or replay. Throws std::system_error if a file cannot be read.
std::string trajectory_hash(const std::filesystem::path& folder);

}  // namespace harness
