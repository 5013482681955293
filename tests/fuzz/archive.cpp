#include "archive.hpp"

#include <algorithm>
#include <fstream>
#include <string>

namespace fuzz {

namespace {

constexpr std::string_view mark = "=== ";

bool is_plain(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
  constexpr std::size_t longest = 64;
  return !name.empty() && name.size() <= longest && name.front() != '.' &&
         name.find_first_not_of(letters) == std::string_view::npos;
}

/// The position at which the next file begins. `from` is the beginning of a line.
std::size_t next_mark(std::string_view archive, std::size_t from) {
  if (archive.substr(from).starts_with(mark)) return from;
  const std::size_t found = archive.find("\n=== ", from);
  return found == std::string_view::npos ? archive.size() : found + 1;
}

}  // namespace

void write(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::filesystem::path> unpack(std::string_view archive, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (std::size_t at = next_mark(archive, 0); at < archive.size();) {
    const std::size_t line_end = std::min(archive.find('\n', at), archive.size());
    const std::string_view name = archive.substr(at + mark.size(), line_end - at - mark.size());
    const std::size_t begin = std::min(line_end + 1, archive.size());
    at = next_mark(archive, begin);
    const std::filesystem::path path = folder / std::string(name);
    if (!is_plain(name) || std::ranges::find(paths, path) != paths.end()) continue;
    write(path, archive.substr(begin, at - begin));
    paths.push_back(path);
  }
  return paths;
}

}  // namespace fuzz
