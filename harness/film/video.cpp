#include "harness/film/video.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "harness/figures/piped_program.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {

namespace {

/// Converts to BT.709 and tags the video as such: players take small untagged video for BT.601 and show wrong
/// colours.
constexpr std::string_view bt709 =
    "-vf scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+bitexact,format=yuv420p "
    "-colorspace bt709 -color_primaries bt709 -color_trc bt709 -color_range tv";

// The number of threads is fixed, because the bytes of the file depend on it.
constexpr std::string_view h264 =
    "-c:v libx264 -preset veryfast -crf 20 -threads 2 -movflags +faststart -f mp4";
constexpr std::string_view vp9 =
    "-c:v libvpx-vp9 -deadline realtime -cpu-used 8 -row-mt 1 -crf 30 -b:v 0 -threads 2 -f webm";

// What a GIF is made of once all frames are known: the frames without loss, with exact times.
constexpr std::string_view lossless = "-c:v libx264rgb -preset ultrafast -qp 0 -threads 2 -f nut";

std::string codec(VideoFormat video) {
  if (video == VideoFormat::gif) return std::string(lossless);
  return fmt::format("{} {}", bt709, video == VideoFormat::mp4 ? h264 : vp9);
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

/// The name of a file for ffmpeg; the prefix allows names with a leading dash or a colon.
std::string named(const std::filesystem::path& file) { return "file:" + file.string(); }

/// The ffmpeg command with its arguments, for frames as rows of bytes (red, green, blue). The same frames
/// give the same bytes.
std::vector<std::string> command(const std::filesystem::path& file, VideoFormat video,
                                 const FrameFormat& format) {
  std::vector<std::string> arguments = words_of(
      fmt::format("ffmpeg -loglevel level+error -nostdin -y "
                  "-f rawvideo -pixel_format rgb24 -video_size {}x{} -framerate {} -i pipe:0 {} -bitexact "
                  "-map_metadata -1",
                  format.width, format.height, format.fps, codec(video)));
  arguments.push_back(named(file));
  return arguments;
}

/// The command that finds one palette for all frames of a GIF.
std::vector<std::string> palette_command(const std::filesystem::path& frames,
                                         const std::filesystem::path& palette) {
  return {"ffmpeg",      "-loglevel",   "level+error",
          "-nostdin",    "-y",          "-i",
          named(frames), "-vf",         "palettegen=max_colors=128:stats_mode=full",
          "-bitexact",   named(palette)};
}

/// The command that writes a GIF with this palette. No dithering: its pattern changes from frame to frame, and
/// plain areas flicker.
std::vector<std::string> gif_command(const std::filesystem::path& frames,
                                     const std::filesystem::path& palette, int fps,
                                     const std::filesystem::path& file) {
  constexpr int highest_rate = 50;  // [1/s] GIF counts in 1/100 s; players slow down frames of one tick
  const std::string rate = fps > highest_rate ? fmt::format("fps={}", highest_rate) : "null";
  return {"ffmpeg",
          "-loglevel",
          "level+error",
          "-nostdin",
          "-y",
          "-i",
          named(frames),
          "-i",
          named(palette),
          "-filter_complex",
          fmt::format("[0]{}[frames];[frames][1]paletteuse=dither=none:diff_mode=rectangle", rate),
          "-loop",
          "0",
          "-f",
          "gif",
          "-bitexact",
          "-map_metadata",
          "-1",
          named(file)};
}

PipedProgram start(const std::vector<std::string>& arguments) try {
  return PipedProgram(arguments);
} catch (const std::system_error& error) {
  if (error.code() == std::errc::no_such_file_or_directory)
    throw std::runtime_error("ffmpeg is missing: install ffmpeg (Debian)");
  throw;
}

constexpr std::array<std::string_view, 3> levels = {"[error] ", "[fatal] ", "[panic] "};

/// ffmpeg's exit code does not reveal that the end of a film could not be written; its messages do.
bool tells_of_an_error(const std::string& complaint) {
  return std::ranges::any_of(
      levels, [&](std::string_view level) { return complaint.find(level) != std::string::npos; });
}

std::string without_levels(std::string complaint) {
  for (const std::string_view level : levels) {
    for (std::size_t at = complaint.find(level); at != std::string::npos; at = complaint.find(level, at))
      complaint.erase(at, level.size());
  }
  return complaint;
}

class VideoSink : public FrameSink {
 public:
  VideoSink(const std::filesystem::path& file, VideoFormat video, const FrameFormat& format)
      : file_(file), video_(video), format_(format), encoder_(start(command(fresh(), video, format))) {}

  void write(const render::Image& frame) override {
    if (frame.width != format_.width || frame.height != format_.height)
      throw std::invalid_argument("a frame of another size");
    if (!encoder_.send(frame.rgb)) fail(encoder_);
  }

  void finish() override {
    wait_for(encoder_);
    if (video_ == VideoFormat::gif) make_gif();
    rename_output(unfinished(), file_, Existing::replace);
  }

 private:
  /// Removes an old file first, so that nothing is written through an existing link.
  std::filesystem::path fresh() const {
    std::error_code ignored;
    std::filesystem::remove(unfinished(), ignored);
    return unfinished();
  }

  /// The path of the film until it is complete.
  std::filesystem::path unfinished() const { return file_.string() + ".part"; }
  /// The path of a GIF while it is made from the unfinished film.
  std::filesystem::path second_pass() const { return file_.string() + ".gif.part"; }

  /// Replaces the frames without loss by a GIF of one palette. ffmpeg reads the frames twice from the disk, so
  /// that memory stays bounded.
  void make_gif() {
    const TemporaryFolder folder;
    const std::filesystem::path palette = folder / "palette.png";
    PipedProgram first = start(palette_command(unfinished(), palette));
    wait_for(first);
    PipedProgram second = start(gif_command(unfinished(), palette, format_.fps, second_pass()));
    wait_for(second);
    std::filesystem::rename(second_pass(), unfinished());
  }

  void wait_for(PipedProgram& program) {
    if (!program.finish() || tells_of_an_error(program.complaint())) fail(program);
  }

  [[noreturn]] void fail(PipedProgram& program) {
    static_cast<void>(program.finish());  // wait until ffmpeg has written all its messages
    std::error_code ignored;
    for (const std::filesystem::path& part : {unfinished(), second_pass()})
      std::filesystem::remove(part, ignored);
    std::string reason = without_levels(program.complaint());
    reason.erase(std::find_if(reason.rbegin(), reason.rend(), [](char c) { return c != '\n'; }).base(),
                 reason.end());
    throw std::runtime_error(fmt::format("cannot write {}: {}", file_.string(),
                                         reason.empty() ? "ffmpeg ended before the film did" : reason));
  }

  std::filesystem::path file_;
  VideoFormat video_;
  FrameFormat format_;
  PipedProgram encoder_;
};

}  // namespace

std::unique_ptr<FrameSink> make_video_sink(const std::filesystem::path& file, VideoFormat video,
                                           const FrameFormat& format) {
  return std::make_unique<VideoSink>(file, video, format);
}

}  // namespace harness
