// Locks that tell whether a process that works on a file or a folder still lives. The system lifts a lock when
// its last holder ends, whatever ended it.
#pragma once

#include <filesystem>

namespace harness {

/// Holds a shared lock on a file or a folder that exists, as long as the object and the processes forked
/// meanwhile live. Where the file system has no locks, it holds nothing.
class FileLock {
 public:
  FileLock() = default;
  explicit FileLock(const std::filesystem::path& path);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;

 private:
  int descriptor_ = -1;
};

/// True if a lock is held on it, by whatever process.
bool is_locked(const std::filesystem::path& path);

}  // namespace harness
