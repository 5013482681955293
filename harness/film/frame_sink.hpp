// The destination of a film's frames: a video, a sequence of pictures, or a single picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "harness/files/output_file.hpp"
#include "sim/render/image.hpp"

namespace harness {

struct FrameFormat {
  int width = 0;   // [px]
  int height = 0;  // [px]
  int fps = 0;     // [1/s]
};

class FrameSink {
 public:
  /// An unfinished film stays on disk as NAME.part and can be watched.
  virtual ~FrameSink() = default;
  /// Writes a frame. Throws std::runtime_error if this fails.
  virtual void write(const render::Image& frame) = 0;
  /// Ends the film and waits until all of it is on disk. Throws std::runtime_error if this fails.
  virtual void finish() = 0;
};

/// Makes the sink for a file by its extension: .mp4 (H.264), .webm (VP9), .gif, or .png. A .png gives one
/// numbered file for each frame, or a single file if `is_still`. Throws BadInput for another extension, and
/// std::runtime_error if the encoder is not installed, with a message that says what to install.
std::unique_ptr<FrameSink> make_frame_sink(const std::filesystem::path& file, const FrameFormat& format,
                                           bool is_still);

/// Throws BadInput if such a sink may not write there, or if there are numbered pictures of this name that are
/// to be kept: pictures of two films would be mixed up.
void check_frame_sink(const std::filesystem::path& file, bool is_still, Existing existing);

/// The names of all files that such a sink has written, for a message: for many numbered pictures the first
/// and the last.
std::string files_of(const std::filesystem::path& file, bool is_still, std::int64_t frames);

}  // namespace harness
