// Films as video files, encoded by the program ffmpeg.
#pragma once

#include <filesystem>
#include <memory>

#include "harness/film/frame_sink.hpp"

namespace harness {

enum class VideoFormat { mp4, webm, gif };

/// The same frames give the same bytes. Throws std::runtime_error if ffmpeg is not installed.
std::unique_ptr<FrameSink> make_video_sink(const std::filesystem::path& file, VideoFormat video,
                                           const FrameFormat& format);

}  // namespace harness
