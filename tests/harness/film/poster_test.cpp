#include "harness/film/poster.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/film/frame_sink.hpp"
#include "harness/fixtures.hpp"
#include "sim/render/png.hpp"

namespace harness {
namespace {

constexpr FrameFormat small_film{64, 48, 10};

render::Image plain_frame(std::uint8_t brightness) {
  constexpr std::size_t channels = std::size_t{3} * small_film.width * small_film.height;
  return {small_film.width, small_film.height, std::vector<std::uint8_t>(channels, brightness)};
}

/// A film that is white but for its last frame.
void write_white_film(const std::filesystem::path& file, int frames) {
  const auto sink = make_frame_sink(file, small_film, false);
  for (int i = 1; i < frames; ++i) sink->write(plain_frame(255));
  sink->write(plain_frame(40));
  sink->finish();
}

TEST(Poster, IsTheLastFrameOfAFilm) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "-i.webm"}) {
    for (const int frames : {2, 25}) {
      write_white_film(folder / name, frames);
      test::write_file(folder / "poster.jpg", poster_of(folder / name));
      const std::string command = "ffmpeg -v error -y -i '" + (folder / "poster.jpg").string() + "' '" +
                                  (folder / "poster.png").string() + "'";
      ASSERT_EQ(std::system(command.c_str()), 0) << name << ' ' << frames;
      const render::Image poster = render::read_png(folder / "poster.png");
      EXPECT_EQ(poster.width, small_film.width);
      EXPECT_NEAR(*poster.pixel(30, 20), 40, 10) << name << ' ' << frames;
    }
  }
}

TEST(Poster, HasTheSameBytesAgain) {
  const TemporaryFolder folder;
  write_white_film(folder / "film.mp4", 5);
  EXPECT_EQ(poster_of(folder / "film.mp4"), poster_of(folder / "film.mp4"));
}

TEST(Poster, IsMissingIfTheFilmCannotBeRead) {
  const TemporaryFolder folder;
  test::write_file(folder / "film.mp4", "moving");
  EXPECT_EQ(poster_of(folder / "film.mp4"), "");
  EXPECT_EQ(poster_of(folder / "none.mp4"), "");
}

}  // namespace
}  // namespace harness
