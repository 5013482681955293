#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>

#include "harness/recording/run_folder.hpp"

namespace harness {

namespace {

constexpr std::string_view temporary_name = "seifbed_";

/// The process that a temporary folder is named after; 0 if the name is not that of one.
pid_t process_of(std::string_view name) {
  if (!name.starts_with(temporary_name)) return 0;
  name.remove_prefix(temporary_name.size());
  pid_t process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  const bool has_end = error == std::errc() && end != name.data() + name.size() && *end == '_';
  return has_end && process > 0 ? process : 0;
}

/// True if a folder is this user's, its process has ended, and nobody holds its lock: in a container, a number
/// may be that of another process, or of none.
bool is_left(const std::filesystem::path& folder) {
  const pid_t process = process_of(folder.filename().string());
  if (process == 0 || ::kill(process, 0) == 0 || errno != ESRCH) return false;
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
    return false;
  return !is_locked(folder);
}

void sweep_left_folders(const std::filesystem::path& parent) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (is_left(entry->path())) std::filesystem::remove_all(entry->path(), ignored);
  }
}

}  // namespace

std::filesystem::path TemporaryFolder::make() {
  static std::once_flag swept;
  const std::filesystem::path parent = std::filesystem::temp_directory_path();
  std::call_once(swept, [&] { sweep_left_folders(parent); });
  std::string pattern = (parent / fmt::format("{}{}_XXXXXX", temporary_name, ::getpid())).string();
  if (mkdtemp(pattern.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), fmt::format("cannot create {}", pattern));
  return pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace harness
