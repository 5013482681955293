#include "harness/sweep/cells.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <optional>
#include <system_error>

namespace harness {

namespace {

constexpr const char* done_suffix = ".json";
constexpr const char* failed_suffix = ".failed";
constexpr const char* unfinished = ".unfinished";

/// The temporary path for a file that is to become `path`. No other living process uses the same one.
std::filesystem::path part_of(const std::filesystem::path& path) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  const std::filesystem::path part =
      fmt::format("{}.{}-{}{}", path.string(), host.data(), getpid(), unfinished);
  std::filesystem::remove(part);
  return part;
}

/// A new name in a folder is on the disk only when the folder is.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool is_synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!is_synced)
    throw std::system_error(error, std::generic_category(), fmt::format("cannot write {}", folder.string()));
}

/// The index in the name of a file.
std::optional<std::size_t> index_of(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), index);
  if (error != std::errc() || end != stem.data() + stem.size()) return std::nullopt;
  return index;
}

}  // namespace

DurableFile::DurableFile(std::filesystem::path path) : path_(std::move(path)), file_(part_of(path_)) {}

void DurableFile::commit() {
  file_.sync();
  file_.close();
  std::filesystem::rename(file_.path(), path_);
  sync_folder(path_.parent_path());
}

void write_durable_file(const std::filesystem::path& path, std::string_view text) {
  DurableFile file(path);
  file.append(text);
  file.commit();
}

void remove_unfinished_files(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == unfinished) std::filesystem::remove(entry.path());
  }
}

std::vector<CellState> CellFolder::states(std::size_t count) const {
  std::vector<CellState> states(count, CellState::open);
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::optional<std::size_t> index = index_of(entry.path());
    if (!index || *index >= count) continue;
    if (entry.path().extension() == done_suffix) {
      states[*index] = CellState::done;
    } else if (entry.path().extension() == failed_suffix && states[*index] == CellState::open) {
      states[*index] = CellState::failed;
    }
  }
  return states;
}

std::string CellFolder::result(std::size_t index) const { return read_whole_file(path(index, done_suffix)); }

std::string CellFolder::failure(std::size_t index) const {
  return read_whole_file(path(index, failed_suffix));
}

void CellFolder::put_result(std::size_t index, std::string_view text) const {
  write_durable_file(path(index, done_suffix), text);
  std::filesystem::remove(path(index, failed_suffix));
}

void CellFolder::put_failure(std::size_t index, std::string_view reason) const {
  write_durable_file(path(index, failed_suffix), reason);
}

std::filesystem::path CellFolder::path(std::size_t index, const char* extension) const {
  return folder_ / fmt::format("{:06}{}", index, extension);
}

}  // namespace harness
