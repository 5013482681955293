#include "harness/film/pictures.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <string>
#include <system_error>

#include "sim/render/png.hpp"

namespace harness {

namespace {

/// Writes to a temporary file and renames it: at any time the file is a complete picture, the old or the new
/// one.
void write_whole(const std::filesystem::path& file, const render::Image& image) {
  std::filesystem::path unfinished = file;
  unfinished += fmt::format(".{}.part", getpid());
  try {
    render::write_png(unfinished, image);
    std::filesystem::rename(unfinished, file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw;
  }
}

class PictureSequence : public FrameSink {
 public:
  explicit PictureSequence(std::filesystem::path file) : file_(std::move(file)) {}

  void write(const render::Image& frame) override { write_whole(numbered_picture(file_, next_++), frame); }

  void finish() override {}

 private:
  std::filesystem::path file_;
  std::int64_t next_ = 0;
};

class Still : public FrameSink {
 public:
  explicit Still(std::filesystem::path file) : file_(std::move(file)) {}
  void write(const render::Image& frame) override { write_whole(file_, frame); }
  void finish() override {}

 private:
  std::filesystem::path file_;
};

}  // namespace

std::filesystem::path numbered_picture(const std::filesystem::path& file, std::int64_t number) {
  return file.parent_path() /
         fmt::format("{}_{:05}{}", file.stem().string(), number, file.extension().string());
}

std::unique_ptr<FrameSink> make_picture_sequence(const std::filesystem::path& file) {
  return std::make_unique<PictureSequence>(file);
}

std::unique_ptr<FrameSink> make_still(const std::filesystem::path& file) {
  return std::make_unique<Still>(file);
}

}  // namespace harness
