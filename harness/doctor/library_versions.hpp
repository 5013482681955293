// The libraries that this build was made with.
#pragma once

#include <span>
#include <string_view>

namespace harness {

struct LibraryVersion {
  std::string_view name;
  std::string_view version;  // "unknown" if the library does not give it
};

std::span<const LibraryVersion> library_versions();

}  // namespace harness
