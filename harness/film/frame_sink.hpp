// Where the frames of a film go: a video, pictures, or one picture.
#pragma once

#include <filesystem>
#include <memory>

#include "sim/render/image.hpp"

namespace harness {

struct FrameFormat {
  int width = 0;   // [px]
  int height = 0;  // [px]
  int fps = 0;     // [1/s]
};

class FrameSink {
 public:
  /// An unfinished film stays as NAME.part; the part written so far can be played.
  virtual ~FrameSink() = default;
  /// Throws std::runtime_error if it cannot be written.
  virtual void write(const render::Image& frame) = 0;
  /// Ends the film and waits until all of it is on disk. Throws as above.
  virtual void finish() = 0;
};

/// By the name of the file: .mp4 (H.264), .webm (VP9), .gif, .png (frames numbered after the stem;
/// `is_still`: this very file). Throws BadInput for any other, and std::runtime_error saying what to install
/// if the encoder is missing.
std::unique_ptr<FrameSink> make_frame_sink(const std::filesystem::path& file, const FrameFormat& format,
                                           bool is_still);

}  // namespace harness
