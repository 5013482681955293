// Which files may be opened for reading.
#pragma once

#include <filesystem>
#include <string>

namespace worlds {

/// Why this file must not be opened; empty if it is a regular file, or a link to one. A pipe without a writer
/// would never open, and a device may never end. To be asked before any file is opened that a user named, or
/// that lies in a folder that a user named.
std::string why_no_input(const std::filesystem::path& file);

}  // namespace worlds
