// Images as PNG files.
#pragma once

#include <filesystem>

#include "sim/render/image.hpp"

namespace render {

/// The same image gives the same bytes. Throws std::runtime_error with the name of the file.
void write_png(const std::filesystem::path& path, const Image& image);
Image read_png(const std::filesystem::path& path);

}  // namespace render
