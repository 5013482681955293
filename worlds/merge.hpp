// Combines documents: `extends` between files, and `--set` from the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "worlds/document.hpp"

namespace worlds {

/// Reads a file and the file that it `extends` (a path relative to the extending file). Maps are merged key by
/// key. Any other value of the extending file replaces the old one; a null removes it.
std::optional<Node> read_extended_document(const std::filesystem::path& file, std::vector<Problem>& problems);

/// Applies `path.to.key=value`. The value is YAML, and replaces the whole old value. In a list, a number in the
/// path is an index. Maps that are missing on the path are made. The source of the new value, and so of every
/// problem with it, is `--set path.to.key=value`.
void apply_override(Node& root, const std::string& assignment, std::vector<Problem>& problems);

}  // namespace worlds
