#include "harness/recording/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/fnv1a.hpp"
#include "harness/files/input_file.hpp"

namespace harness {

namespace {

bool is_hashed(const std::string& name) {
  return name == "truth.csv" || name == "odometry.csv" || name == "observations.csv" ||
         name.ends_with(".tum") || name.ends_with("_map.csv");
}

void add_file(Fnv1a& hash, const std::filesystem::path& path) {
  std::ifstream file = open_input(path);
  std::array<char, 1 << 16> block;
  while (file) {
    file.read(block.data(), block.size());
    hash.add({block.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof())
    throw std::system_error(EIO, std::generic_category(), fmt::format("cannot read {}", path.string()));
}

}  // namespace

std::string file_name_of(std::string_view name) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
  constexpr std::size_t longest = 100;  // [byte] well below file systems' limits, with room for a suffix
  std::string result(name.substr(0, longest));
  for (char& c : result) {
    if (allowed.find(c) == std::string_view::npos) c = '_';
  }
  if (result.empty() || result.front() == '.' || result.front() == '-') result.insert(result.begin(), '_');
  return result;
}

std::filesystem::path create_run_folder(const std::filesystem::path& parent, const std::string& name) {
  std::error_code error;
  std::filesystem::create_directories(parent, error);
  std::filesystem::path folder = parent / name;
  // create_directory is one mkdir: only the process that makes the folder gets true.
  for (int next = 2; !error && !std::filesystem::create_directory(folder, error); ++next)
    folder = parent / fmt::format("{}-{}", name, next);
  if (!error) return folder;
  if (error == std::errc::no_space_on_device)
    throw std::filesystem::filesystem_error("no folder can be made", folder, error);
  std::error_code lost;
  const std::filesystem::path here = std::filesystem::current_path(lost);
  if (lost) throw BadInput("the working folder was deleted or moved; change to another one");
  throw BadInput(fmt::format("{}: no folder can be made here, in {}: {}; --out says where to write instead",
                             parent.string(), here.string(), error.message()));
}

void refuse_team_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder / "world.yaml", error) ||
      std::filesystem::exists(folder / "log.yaml", error))
    return;
  std::vector<std::string> robots;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder, error)) {
    if (std::filesystem::exists(entry.path() / "log.yaml", error)) robots.push_back(entry.path().string());
  }
  if (robots.empty()) return;
  throw BadInput(fmt::format("{}: is the folder of {} robots; name the folder of one of them, such as {}",
                             folder.string(), robots.size(), *std::ranges::min_element(robots)));
}

std::filesystem::path create_empty_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw BadInput(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  const bool is_empty = std::filesystem::is_empty(folder, error);
  if (error) throw BadInput(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (!is_empty)
    throw BadInput(fmt::format("{}: is not empty; a run never writes over another", folder.string()));
  return folder;
}

std::filesystem::path free_file(const std::filesystem::path& folder, const std::filesystem::path& name) {
  std::filesystem::path file = folder / name;
  for (int number = 2; std::filesystem::exists(file); ++number)
    file = folder / fmt::format("{}-{}{}", name.stem().string(), number, name.extension().string());
  return file;
}

std::string trajectory_hash(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (is_hashed(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  Fnv1a hash;
  for (const std::string& name : names) {
    hash.add(name);
    hash.add(std::string_view("\0", 1));
    add_file(hash, folder / name);
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace harness
