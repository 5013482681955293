// Documents made of several: `extends` between files, and `--set` from the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "worlds/document.hpp"

namespace worlds {

/// Reads a file and what it `extends` (a path relative to the file that says it). Maps are merged key by key;
/// everything else of the extending file replaces what was there, and a null takes it away.
std::optional<Node> read_extended_document(const std::filesystem::path& file, std::vector<Problem>& problems);

/// Sets what `path.to.key=value` says; the value is YAML, and replaces what was there as a whole. Numbers in
/// the path are indices where a list stands; maps that are missing on the way are made. The source of the new
/// value, and so of every problem with it, is `--set path.to.key=value`.
void apply_override(Node& root, const std::string& assignment, std::vector<Problem>& problems);

}  // namespace worlds
