// The folder of a run. A second run never overwrites the first.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "harness/files/file_lock.hpp"

namespace harness {

/// A name that can be part of a path: every character but letters, digits, '.', '_' and '-' is replaced.
std::string file_name_of(std::string_view name);

/// Creates the first free folder of parent/name, parent/name-2, parent/name-3, ... Two programs at the same
/// time get two folders. Throws BadInput.
std::filesystem::path create_run_folder(const std::filesystem::path& parent, const std::string& name);

/// Throws BadInput if this is the folder of several robots, of which each has a run folder in it.
void refuse_team_folder(const std::filesystem::path& folder);

/// Creates exactly this folder, or uses it if it exists and is empty. Otherwise throws BadInput.
std::filesystem::path create_empty_folder(const std::filesystem::path& folder);

/// The first free path of folder/name and the same with -2, -3, ... before the extension.
std::filesystem::path free_file(const std::filesystem::path& folder, const std::filesystem::path& name);

/// A temporary folder, seifbed_PID_XXXXXX. It is deleted with its contents when the object is destroyed. The
/// first one of a process also deletes those that killed processes of this user have left.
class TemporaryFolder {
 public:
  TemporaryFolder() : TemporaryFolder(make()) {}  // throws std::system_error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)), lock_(path_) {}
  static std::filesystem::path make();

  std::filesystem::path path_;
  FileLock lock_;
};

/// 16 hex digits over the names and bytes of what a run saw and estimated: truth.csv, odometry.csv,
/// observations.csv, all *.tum and all *_map.csv, sorted by name (FNV-1a, 64 bits). A run and its repetition
/// or replay have the same hash. Throws BadInput or std::system_error if a file cannot be read.
std::string trajectory_hash(const std::filesystem::path& folder);

}  // namespace harness
