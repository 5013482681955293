// Several files in one text, so that a fuzzer can change them all:
//   === odometry.csv
//   t,dx,dy,dtheta,...
//   === log.yaml
//   ...
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace fuzz {

/// Writes the files to a folder and returns their paths. Leaves out files whose names could lead out of the
/// folder, and duplicate names.
std::vector<std::filesystem::path> unpack(std::string_view archive, const std::filesystem::path& folder);

void write(const std::filesystem::path& path, std::string_view text);

}  // namespace fuzz
