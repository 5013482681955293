// The picture that stands for a film before it plays.
#pragma once

#include <filesystem>
#include <string>

namespace harness {

/// The last frame of a film as a JPEG, at most 1280 pixels wide: at its end a film shows the whole map, at its
/// beginning none of it. Empty if ffmpeg is not installed or cannot read the film.
std::string poster_of(const std::filesystem::path& film);

}  // namespace harness
