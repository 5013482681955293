// Opening files for reading.
#pragma once

#include <filesystem>
#include <fstream>

namespace harness {

/// Opens a file for reading. Pipes, devices and directories are refused before they are opened, so that nothing
/// waits for them. Throws BadInput.
std::ifstream open_input(const std::filesystem::path& file);

}  // namespace harness
