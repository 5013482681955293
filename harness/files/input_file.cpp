#include "harness/files/input_file.hpp"

#include <fmt/format.h>

#include <string>

#include "harness/files/bad_input.hpp"
#include "worlds/input_file.hpp"

namespace harness {

std::ifstream open_input(const std::filesystem::path& file) {
  if (const std::string why = worlds::why_no_input(file); !why.empty())
    throw BadInput(fmt::format("{}: cannot be read: {}", file.string(), why));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw BadInput(fmt::format("{}: cannot be read", file.string()));
  return stream;
}

}  // namespace harness
