#include "harness/sweep/folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <system_error>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"

namespace harness {

namespace {

constexpr const char* plan_file = "sweep.json";
constexpr std::array<const char*, 2> world_files = {"world.yaml",
                                                    "commands.csv"};  // the second one may be missing

/// The path without `.`, `..` and a final slash.
std::filesystem::path tidy(const std::filesystem::path& folder) {
  const std::filesystem::path full = std::filesystem::weakly_canonical(std::filesystem::absolute(folder));
  return full.has_filename() ? full : full.parent_path();
}

/// Renames a folder. False if `name` exists and is not empty.
bool take_name(const std::filesystem::path& folder, const std::filesystem::path& name) {
  std::error_code error;
  std::filesystem::rename(folder, name, error);
  if (!error) return true;
  if (error == std::errc::directory_not_empty || error == std::errc::file_exists) return false;
  throw BadInput(fmt::format("{}: cannot be created: {}", name.string(), error.message()));
}

/// A folder beside another one. It is deleted with its contents unless it was renamed.
class FolderInMaking {
 public:
  explicit FolderInMaking(const std::filesystem::path& name)
      : path_(fmt::format("{}.unfinished-{}", name.string(), getpid())) {
    std::filesystem::remove_all(path_);
    std::error_code error;
    std::filesystem::create_directories(path_ / "cells", error);
    if (error) throw BadInput(fmt::format("{}: cannot be created: {}", name.string(), error.message()));
  }
  ~FolderInMaking() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FolderInMaking(const FolderInMaking&) = delete;
  FolderInMaking& operator=(const FolderInMaking&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  const bool is_there = std::filesystem::exists(a);
  if (is_there != std::filesystem::exists(b)) return false;
  return !is_there || read_whole_file(a) == read_whole_file(b);
}

}  // namespace

SweepFolder open_sweep(const std::filesystem::path& folder) {
  const std::filesystem::path path = tidy(folder);
  if (!std::filesystem::exists(path / plan_file))
    throw BadInput(fmt::format("{}: is no folder of a sweep: it has no {}", folder.string(), plan_file));
  return {path, plan_from_json(read_whole_file(path / plan_file), (path / plan_file).string())};
}

SweepFolder begin_sweep(const std::filesystem::path& folder, const SweepPlan& plan,
                        const std::function<void(const std::filesystem::path&)>& write_world) {
  const std::filesystem::path path = tidy(folder);
  const FolderInMaking begun(path);
  write_world(begun.path());
  write_durable_file(begun.path() / plan_file, to_json(plan));
  if (take_name(begun.path(), path)) return {path, plan};
  if (!std::filesystem::exists(path / plan_file))
    throw BadInput(fmt::format("{}: is not empty, and is no folder of a sweep", folder.string()));
  SweepFolder there = open_sweep(path);
  check_same_sweep(there, {begun.path(), plan});
  return there;
}

void check_same_sweep(const SweepFolder& theirs, const SweepFolder& ours) {
  std::string reason;
  if (!(theirs.plan == ours.plan)) reason = difference_between(theirs.plan, ours.plan);
  for (const char* file : world_files) {
    if (reason.empty() && !same_file(theirs.path / file, ours.path / file))
      reason = fmt::format("its {} is not the same", file);
  }
  if (reason.empty()) return;
  throw BadInput(fmt::format("{}: holds another sweep: {}; to go on with it: seifbed sweep --resume {}",
                             theirs.path.string(), reason, theirs.path.string()));
}

FileLock lock_of_sweep(const SweepFolder& sweep) { return FileLock(sweep.path / plan_file); }

bool is_going_on(const SweepFolder& sweep) { return is_locked(sweep.path / plan_file); }

void remove_unfinished(const SweepFolder& sweep) {
  remove_unfinished_files(sweep.path);
  remove_unfinished_files(sweep.path / "cells");
}

void copy_world(const SweepFolder& from, const std::filesystem::path& to) {
  for (const char* file : world_files) {
    if (std::filesystem::exists(from.path / file)) std::filesystem::copy_file(from.path / file, to / file);
  }
}

}  // namespace harness
