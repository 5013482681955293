// Films as PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "harness/film/frame_sink.hpp"

namespace harness {

/// Each frame in a file of its own: for a.png a_00000.png, a_00001.png, ...
std::unique_ptr<FrameSink> make_picture_sequence(const std::filesystem::path& file);

/// The file of one of these frames.
std::filesystem::path numbered_picture(const std::filesystem::path& file, std::int64_t number);

/// All files there are whose names are those of such frames, in order.
std::vector<std::filesystem::path> numbered_pictures(const std::filesystem::path& file);

/// One frame, in exactly this file.
std::unique_ptr<FrameSink> make_still(const std::filesystem::path& file);

}  // namespace harness
