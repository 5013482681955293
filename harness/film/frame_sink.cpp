#include "harness/film/frame_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "harness/files/bad_input.hpp"
#include "harness/film/pictures.hpp"
#include "harness/film/video.hpp"

namespace harness {

namespace {

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::optional<VideoFormat> video_format(const std::string& extension) {
  if (extension == ".mp4") return VideoFormat::mp4;
  if (extension == ".webm") return VideoFormat::webm;
  if (extension == ".gif") return VideoFormat::gif;
  return std::nullopt;
}

void check_format(const FrameFormat& format) {
  const auto is_good = [](int size) { return size > 0 && size % 2 == 0; };
  if (!is_good(format.width) || !is_good(format.height))
    throw BadInput(fmt::format("a film must have an even width and height, not {} x {} pixels", format.width,
                               format.height));
  if (format.fps <= 0) throw BadInput(fmt::format("a film cannot have {} frames a second", format.fps));
}

}  // namespace

std::unique_ptr<FrameSink> make_frame_sink(const std::filesystem::path& file, const FrameFormat& format,
                                           bool is_still) {
  const std::string extension = lower_case(file.extension().string());
  const std::optional<VideoFormat> video = video_format(extension);
  if (!video && extension != ".png")
    throw BadInput(fmt::format("{}: a film is a .mp4, .webm, .gif or .png", file.string()));
  if (is_still && video) throw BadInput(fmt::format("{}: a single picture is a .png", file.string()));
  check_format(format);
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  if (video) return make_video_sink(file, *video, format);
  return is_still ? make_still(file) : make_picture_sequence(file);
}

void check_frame_sink(const std::filesystem::path& file, bool is_still, Existing existing) {
  if (is_still || video_format(lower_case(file.extension().string()))) return check_output(file, existing);
  for (const std::filesystem::path& picture : numbered_pictures(file)) check_output(picture, existing);
}

std::string files_of(const std::filesystem::path& file, bool is_still, std::int64_t frames) {
  if (is_still || video_format(lower_case(file.extension().string()))) return file.string();
  const std::string first = numbered_picture(file, 0).string();
  return frames == 1 ? first : fmt::format("{} ... {}", first, numbered_picture(file, frames - 1).string());
}

}  // namespace harness
