// `seifbed film` and `seifbed run --film` on the command line.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"
#include "sim/render/png.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;

class FilmCommand : public testing::Test {
 protected:
  void SetUp() override {
    test::write_file(folder_ / "world.yaml",
                     "name: small\n"
                     "duration_s: 10\n"
                     "landmarks: {generators: [{type: uniform, count: 20}]}\n"
                     "estimators: {ekf: {}, seif: {}}\n"
                     "film: {size_px: [320, 180], fps: 5}\n");
  }

  void run() { ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run").exit_code, 0); }

  /// The number of frames that ffprobe counts.
  std::string frames_of(const std::string& film) {
    const Called probed = test::call_program(
        folder_, "ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 " + film);
    return probed.output;
  }

  TemporaryFolder folder_;
};

TEST_F(FilmCommand, FilmsARunIntoItsFolderAndOverwritesNothing) {
  run();
  const Called first = call(folder_, "film run --speed 2");
  EXPECT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_TRUE(first.output.starts_with("Written to run/film.mp4: 5.2 s, 26 frames")) << first.output;
  EXPECT_EQ(frames_of("run/film.mp4"), "26\n");
  const Called second = call(folder_, "film run --speed 5");
  EXPECT_TRUE(second.output.starts_with("Written to run/film-2.mp4")) << second.output;
  EXPECT_EQ(frames_of("run/film.mp4"), "26\n");
}

TEST_F(FilmCommand, DrawsAMomentAsAPicture) {
  run();
  const Called called = call(folder_, "film run --at 4 --size 640x360 -o four.png");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_EQ(called.output, "Written to four.png\n");
  const render::Image picture = render::read_png(folder_ / "four.png");
  EXPECT_EQ(picture.width, 640);
  EXPECT_EQ(picture.height, 360);
}

TEST_F(FilmCommand, NamesTheNumberedPicturesThatItWrites) {
  run();
  const Called several = call(folder_, "film run --to 2 --speed 1 --out p/f.png");
  EXPECT_EQ(several.exit_code, 0) << several.errors;
  EXPECT_TRUE(several.output.starts_with("Written to p/f_00000.png ... p/f_00010.png: 2.2 s, 11 frames"))
      << several.output;
  const Called one = call(folder_, "film run --to 0 --out one.PNG");
  EXPECT_TRUE(one.output.starts_with("Written to one_00000.PNG: ")) << one.output;
  for (const char* file : {"p/f_00000.png", "p/f_00010.png", "one_00000.PNG"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / file)) << file;
}

TEST_F(FilmCommand, DrawsTheSamePixelsAgain) {
  run();
  call(folder_, "film run --at 7 -o a.png");
  call(folder_, "film run --at 7 -o b.png");
  EXPECT_EQ(test::read_file(folder_ / "a.png"), test::read_file(folder_ / "b.png"));
}

TEST_F(FilmCommand, ShowsAMomentAsTheFilmDoes) {
  run();
  call(folder_, "film run --speed 1 --hide pose_error -o f.png");  // frame 20 is at 4 s
  call(folder_, "film run --at 4 --hide pose_error,caption -o four.png");
  call(folder_, "film run --speed 1 --hide pose_error,caption -o g.png");
  EXPECT_EQ(render::read_png(folder_ / "g_00020.png").rgb, render::read_png(folder_ / "four.png").rgb);
  EXPECT_NE(render::read_png(folder_ / "f_00020.png").rgb, render::read_png(folder_ / "four.png").rgb);
}

TEST_F(FilmCommand, FilmsARunAsItRunsAndChangesNothingInIt) {
  run();
  const Called filmed = call(folder_, "run world.yaml --film --quiet --out filmed");
  EXPECT_EQ(filmed.exit_code, 0) << filmed.errors;
  EXPECT_EQ(frames_of("filmed/film.mp4"), "51\n");
  for (const char* file : {"truth.csv", "ekf.tum", "seif.tum", "seif_map.csv"})
    EXPECT_EQ(test::read_file(folder_ / "filmed" / file), test::read_file(folder_ / "run" / file)) << file;
}

TEST_F(FilmCommand, EndsWithAFilmThatPlaysWhenInterrupted) {
  run();
  const std::string log = (folder_ / "run").string();
  const std::string film = (folder_ / "cut.mp4").string();
  std::vector<std::string> arguments = {SEIFBED_PROGRAM, "film",    log,  "--speed",
                                        "0.02",          "--quiet", "-o", film};
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  ASSERT_EQ(posix_spawn(&child, SEIFBED_PROGRAM, nullptr, nullptr, pointers.data(), environ), 0);
  const std::filesystem::path begun = film + ".part";  // the encoder writes once it has a frame
  while (!std::filesystem::exists(begun) || std::filesystem::file_size(begun) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_GT(std::stoi(frames_of(film)), 0);
}

struct BadCall {
  const char* arguments;
  const char* reason;
};

class BadFilmCalls : public FilmCommand, public testing::WithParamInterface<BadCall> {};

TEST_P(BadFilmCalls, EndWithCodeTwoAndAReason) {
  run();
  const Called called = call(folder_, GetParam().arguments);
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_NE(called.errors.find(GetParam().reason), std::string::npos) << called.errors;
  EXPECT_EQ(called.output, "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run" / "film.mp4"));
}

INSTANTIATE_TEST_SUITE_P(
    Films, BadFilmCalls,
    testing::Values(
        BadCall{"film nowhere", "nowhere"}, BadCall{"film run --at 11", "the run takes 10 s"},
        BadCall{"film run --from 5 --to 4", "nothing to film"},
        BadCall{"film run --at nan", "--at: 'nan' is not allowed: it must be a number from 0 to"},
        BadCall{"film run --from nan", "--from: 'nan' is not allowed: it must be a number from 0 to"},
        BadCall{"film run --to nan", "--to: 'nan' is not allowed: it must be a number from 0 to"},
        BadCall{"film run --at inf", "--at: 'inf' is not allowed: it must be a number from 0 to"},
        BadCall{"film run --to inf", "--to: 'inf' is not allowed: it must be a number from 0 to"},
        BadCall{"film run --from -3", "it must be a number from 0 to"}, BadCall{"film run --at abc", "--at"},
        BadCall{"film run --speed 1e-30", "0 or at least 0.001"},
        BadCall{"film run --speed nan", "a number from 0 to 1000000"},
        BadCall{"film run --camera drone", "drone"}, BadCall{"film run --size 321x180", "multiple of 2"},
        BadCall{"film run --estimators sief", "seif"},
        BadCall{"film run --hide raysss", "did you mean 'rays'"}, BadCall{"film run -o film.avi", ".mp4"},
        BadCall{"film run --set seed=4", "its own section"}, BadCall{"film run --fps 0", "fps"},
        BadCall{"film run --speed -1", "speed"}));

}  // namespace
}  // namespace harness
