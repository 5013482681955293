#include "harness/film/pictures.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <system_error>

#include "harness/files/output_file.hpp"
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
    rename_output(unfinished, file, Existing::replace);
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

std::vector<std::filesystem::path> numbered_pictures(const std::filesystem::path& file) {
  const std::string stem = file.stem().string() + '_';
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  std::vector<std::filesystem::path> pictures;
  std::error_code ignored;  // a folder that is not there holds none
  for (const auto& entry : std::filesystem::directory_iterator(
           file.has_parent_path() ? file.parent_path() : std::filesystem::path("."), ignored)) {
    const std::filesystem::path name = entry.path().filename();
    const std::string own = name.stem().string();
    if (name.extension() == file.extension() && own.starts_with(stem) && own.size() >= stem.size() + 5 &&
        std::all_of(own.begin() + static_cast<std::ptrdiff_t>(stem.size()), own.end(), is_digit))
      pictures.push_back(file.parent_path() / name);
  }
  std::ranges::sort(pictures);
  return pictures;
}

std::unique_ptr<FrameSink> make_picture_sequence(const std::filesystem::path& file) {
  return std::make_unique<PictureSequence>(file);
}

std::unique_ptr<FrameSink> make_still(const std::filesystem::path& file) {
  return std::make_unique<Still>(file);
}

}  // namespace harness
