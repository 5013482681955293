// Film files, examined with ffprobe and ffmpeg.
#include "harness/film/frame_sink.hpp"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "sim/render/png.hpp"

namespace harness {
namespace {

using render::Image;
using test::read_file;
using test::write_file;

constexpr FrameFormat format{128, 96, 25};

using Pixel = std::array<int, 3>;
constexpr std::array<Pixel, 4> quarters = {{{213, 94, 0}, {0, 158, 115}, {0, 114, 178}, {230, 40, 200}}};

/// Four quarters of different colours, and a white square that moves.
Image frame(int number) {
  Image image{format.width, format.height, {}};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool square = x / 8 == number % 16 && y / 8 == 6;
      const std::size_t quarter = (y < image.height / 2 ? 0U : 2U) + (x < image.width / 2 ? 0U : 1U);
      for (const int value : quarters.at(quarter))
        image.rgb.push_back(static_cast<std::uint8_t>(square ? 255 : value));
    }
  }
  return image;
}

void write_frames(FrameSink& sink, int count) {
  for (int i = 0; i < count; ++i) sink.write(frame(i));
}

void write_film(const std::filesystem::path& file, int count, const FrameFormat& its_format = format) {
  const auto sink = make_frame_sink(file, its_format, false);
  write_frames(*sink, count);
  sink->finish();
}

/// The output of a command.
std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot call " + command);
  std::string output;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) output += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return output;
}

/// ffprobe's description of a film, after decoding all of it.
std::map<std::string, std::string> probe(const std::filesystem::path& file) {
  std::istringstream lines(
      output_of("ffprobe -v error -count_frames -show_streams -show_format -of default=noprint_wrappers=1 '" +
                file.string() + "'"));
  std::map<std::string, std::string> values;
  for (std::string line; std::getline(lines, line);)
    values.insert_or_assign(line.substr(0, line.find('=')), line.substr(line.find('=') + 1));
  return values;
}

int frames_in(const std::filesystem::path& file) { return std::stoi(probe(file).at("nb_read_frames")); }

/// The frame as shown by a player that uses the colour information of the file.
Image decoded(const std::filesystem::path& film, int number) {
  const std::string raw = output_of("ffmpeg -v error -i '" + film.string() + "' -vf \"select='eq(n," +
                                    std::to_string(number) + ")'\" -frames:v 1 -f rawvideo -pix_fmt rgb24 -");
  return {format.width, format.height, {raw.begin(), raw.end()}};
}

/// The message of the exception of a call; empty if it throws none.
template <class Error>
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// During its life, programs are searched in this folder only.
class OnlyPath {
 public:
  explicit OnlyPath(const std::filesystem::path& folder) : former_(std::getenv("PATH")) {
    setenv("PATH", folder.c_str(), 1);
  }
  ~OnlyPath() { setenv("PATH", former_.c_str(), 1); }
  OnlyPath(const OnlyPath&) = delete;
  OnlyPath& operator=(const OnlyPath&) = delete;

 private:
  std::string former_;
};

class EveryVideo : public testing::TestWithParam<std::string> {
 protected:
  std::filesystem::path file(const std::string& name) const { return folder_ / (name + GetParam()); }
  std::filesystem::path unfinished(const std::string& name) const {
    return folder_ / (name + GetParam() + ".part");
  }

  TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(FrameSink, EveryVideo, testing::Values(".mp4", ".webm", ".gif"),
                         [](const auto& test) { return test.param.substr(1); });

TEST_P(EveryVideo, HasTheSizeTheRateAndTheFramesThatWereWritten) {
  write_film(file("film"), 40);
  const auto values = probe(file("film"));
  EXPECT_EQ(values.at("width"), "128");
  EXPECT_EQ(values.at("height"), "96");
  EXPECT_EQ(values.at("r_frame_rate"), "25/1");
  EXPECT_EQ(values.at("nb_read_frames"), "40");
  EXPECT_NEAR(std::stod(values.at("duration")), 40 / 25.0, 0.041);
}

TEST_P(EveryVideo, ShowsTheColoursThatWereWritten) {
  write_film(file("film"), 3);
  const Image image = decoded(file("film"), 2);
  ASSERT_EQ(image.rgb.size(), frame(2).rgb.size());
  const int worst = GetParam() == ".gif" ? 0 : 4;  // from 8 bits of brightness, and quantisation
  for (std::size_t quarter = 0; quarter < quarters.size(); ++quarter) {
    const std::uint8_t* pixel = image.pixel(quarter % 2 == 0 ? 32 : 96, quarter < 2 ? 24 : 72);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(pixel[i], quarters.at(quarter).at(i), worst) << quarter;
  }
  EXPECT_GT(*image.pixel(2 * 8 + 4, 6 * 8 + 4), 235) << "the white square, where the third frame has it";
}

TEST_P(EveryVideo, OfTheSameFramesHasTheSameBytes) {
  write_film(file("first"), 60);
  write_film(file("second"), 60);
  EXPECT_EQ(read_file(file("first")), read_file(file("second")));
}

TEST_P(EveryVideo, ThatIsNotFinishedPlaysToWhereItEnds) {
  {
    const auto sink = make_frame_sink(file("film"), format, false);
    write_frames(*sink, 20);
  }
  EXPECT_EQ(frames_in(unfinished("film")), 20);
  EXPECT_FALSE(std::filesystem::exists(file("film")));
}

TEST_P(EveryVideo, OfAGroupOfProgramsThatIsKilledPlaysToWhereItEnds) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // so that we can wait for the encoder of another program
  const pid_t writer = fork();
  if (writer == 0) {
    setpgid(0, 0);
    const auto sink = make_frame_sink(file("film"), format, false);
    write_frames(*sink, 20);
    kill(0, SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(writer, &status, 0), writer);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_GT(wait(&status), 0);
  EXPECT_EQ(frames_in(unfinished("film")), 20);
  EXPECT_FALSE(std::filesystem::exists(file("film")));
}

TEST_P(EveryVideo, TakesThePlaceOfAFormerFile) {
  write_file(file("film"), std::string(1'000'000, 'x'));
  write_film(file("film"), 3);
  EXPECT_EQ(frames_in(file("film")), 3);
  EXPECT_LT(std::filesystem::file_size(file("film")), 1'000'000U);
}

TEST_P(EveryVideo, MayHaveANameThatLooksLikeSomethingElse) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  for (const std::string name : {"-y", "pipe:1", "http://a", "a b'c\"%d"}) {
    write_film(name + GetParam(), 2);
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / (name + GetParam()))) << name;
  }
  std::filesystem::current_path(before);
}

TEST_P(EveryVideo, SaysWhyItCannotBeWritten) {
  std::filesystem::create_directories(file("film"));
  const auto sink = make_frame_sink(file("film"), format, false);
  const std::string message = message_of<std::runtime_error>([&] {
    write_frames(*sink, 1000);
    sink->finish();
  });
  EXPECT_NE(message.find("is a folder"), std::string::npos) << message;
  EXPECT_NE(message.find(file("film").string()), std::string::npos) << message;
}

TEST_P(EveryVideo, FailsIfThereIsNoSpaceLeft) {
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  getrlimit(RLIMIT_FSIZE, &usual);
  const rlimit narrow{100, usual.rlim_max};  // [byte]
  setrlimit(RLIMIT_FSIZE, &narrow);
  const std::string message = message_of<std::runtime_error>([&] { write_film(file("film"), 10); });
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, former);
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path())) << "there is no part of it either";
}

TEST_P(EveryVideo, RefusesAFrameOfAnotherSize) {
  const auto sink = make_frame_sink(file("film"), {64, 64, 25}, false);
  EXPECT_THROW(sink->write(frame(0)), std::invalid_argument);
}

TEST_P(EveryVideo, NeedsTheEncoder) {
  const OnlyPath path(folder_.path());
  EXPECT_EQ(message_of<std::runtime_error>([&] { make_frame_sink(file("film"), format, false); }),
            "ffmpeg is missing: install ffmpeg (Debian)");
}

TEST_P(EveryVideo, SaysWhichCodecTheEncoderLacks) {
  write_file(folder_ / "ffmpeg", "#!/bin/sh\necho \"[fatal] Unknown encoder 'x'\" >&2\nexit 1\n");
  std::filesystem::permissions(folder_ / "ffmpeg", std::filesystem::perms::owner_all);
  const OnlyPath path(folder_.path());
  EXPECT_EQ(message_of<std::runtime_error>([&] { write_film(file("film"), 100); }),
            "cannot write " + file("film").string() + ": Unknown encoder 'x'");
}

TEST(FrameSink, WritesH264AndVp9ThatBrowsersPlay) {
  const TemporaryFolder folder;
  for (const auto& [name, codec] : std::map<std::string, std::string>{{"a.mp4", "h264"}, {"a.WEBM", "vp9"}}) {
    write_film(folder / name, 3);
    const auto values = probe(folder / name);
    EXPECT_EQ(values.at("codec_name"), codec);
    EXPECT_EQ(values.at("pix_fmt"), "yuv420p");
    EXPECT_EQ(values.at("color_range"), "tv");
    for (const char* key : {"color_space", "color_transfer", "color_primaries"})
      EXPECT_EQ(values.at(key), "bt709") << key;
  }
}

TEST(FrameSink, PutsTheIndexOfAnMp4BeforeItsFrames) {
  const TemporaryFolder folder;
  write_film(folder / "film.mp4", 3);
  const std::string bytes = read_file(folder / "film.mp4");
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
}

TEST(FrameSink, LoopsAGifForEver) {
  const TemporaryFolder folder;
  write_film(folder / "film.gif", 3);
  const std::string forever("NETSCAPE2.0\x03\x01\0\0", 15);
  EXPECT_NE(read_file(folder / "film.gif").find(forever), std::string::npos);
}

TEST(FrameSink, GivesAGifNoMoreFramesThanItsClockHasTime) {
  const TemporaryFolder folder;
  write_film(folder / "film.gif", 40, {format.width, format.height, 100});
  const auto values = probe(folder / "film.gif");
  EXPECT_EQ(values.at("r_frame_rate"), "50/1");
  EXPECT_EQ(values.at("nb_read_frames"), "20");
}

TEST(FrameSink, GivesAGifOnePaletteForAllFrames) {
  const TemporaryFolder folder;
  write_film(folder / "film.gif", 60);
  constexpr std::uintmax_t palette = 768;  // [byte]
  EXPECT_LT(std::filesystem::file_size(folder / "film.gif"), 60 * palette);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(FrameSink, NumbersPictures) {
  const TemporaryFolder folder;
  write_film(folder / "new" / "deep" / "a.b.png", 11);
  for (const int number : {0, 9, 10}) {
    char name[32];
    std::snprintf(name, sizeof name, "a.b_%05d.png", number);
    const Image image = render::read_png(folder / "new" / "deep" / name);
    EXPECT_EQ(image.width, format.width);
    EXPECT_EQ(image.rgb, frame(number).rgb) << name;
  }
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder / "new" / "deep"))
    ++files;
  EXPECT_EQ(files, 11U);
}

TEST(FrameSink, MixesNumberedPicturesWithNoOthers) {
  const TemporaryFolder folder;
  const std::filesystem::path film = folder / "a.png";
  check_frame_sink(film, false, Existing::keep);
  check_frame_sink(folder / "none" / "a.png", false, Existing::keep);
  for (const char* other : {"a_1.png", "a_00000x.png", "b_00000.png", "a_00000.jpg", "a.png"})
    write_file(folder / other, "not one of them");
  check_frame_sink(film, false, Existing::keep);
  write_file(folder / "a_00007.png", "one of them");
  EXPECT_THROW(check_frame_sink(film, false, Existing::keep), BadInput);
  check_frame_sink(film, false, Existing::replace);
  std::filesystem::create_directory(folder / "a_123456.png");
  EXPECT_THROW(check_frame_sink(film, false, Existing::replace), BadInput);
}

TEST(FrameSink, WritesAStillUnderItsOwnName) {
  const TemporaryFolder folder;
  write_file(folder / "still.png", "former");
  const auto sink = make_frame_sink(folder / "still.png", format, true);
  EXPECT_EQ(read_file(folder / "still.png"), "former");
  sink->write(frame(3));
  sink->finish();
  EXPECT_EQ(render::read_png(folder / "still.png").rgb, frame(3).rgb);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(FrameSink, LeavesNothingOfAPictureThatCannotBeWritten) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "still.png" / "something");
  const auto sink = make_frame_sink(folder / "still.png", format, true);
  EXPECT_THROW(sink->write(frame(0)), std::runtime_error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(FrameSink, MakesFoldersThatAreMissing) {
  const TemporaryFolder folder;
  write_film(folder / "new" / "deep" / "film.gif", 2);
  EXPECT_EQ(frames_in(folder / "new" / "deep" / "film.gif"), 2);
}

TEST(FrameSink, RefusesWhatIsNoFilm) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const FrameFormat& its_format, bool is_still) {
    return message_of<BadInput>([&] { make_frame_sink(folder / name, its_format, is_still); });
  };
  for (const char* name : {"film.avi", "film", "mp4", ".mp4"})
    EXPECT_NE(refused(name, format, false).find("a film is a .mp4, .webm, .gif or .png"), std::string::npos);
  EXPECT_NE(refused("film.mp4", format, true).find("a single picture is a .png"), std::string::npos);
  for (const std::string name : {"film.mp4", "film.webm", "film.gif", "film.png"}) {
    EXPECT_NE(refused(name, {127, 96, 25}, false).find("even width and height"), std::string::npos);
    EXPECT_NE(refused(name, {128, 95, 25}, false), "");
    EXPECT_NE(refused(name, {0, 96, 25}, false), "");
    EXPECT_NE(refused(name, {128, -96, 25}, false), "");
    EXPECT_NE(refused(name, {128, 96, 0}, false), "");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace harness
