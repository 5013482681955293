// What remains when something fails in the middle of a run.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"
#include "limited_call.hpp"

namespace harness {
namespace {

namespace fs = std::filesystem;
using test::call;
using test::Called;
using test::Ended;
using test::Process;
using test::read_file;

class Faults : public testing::Test {
 protected:
  void SetUp() override {
    test::write_file(folder_ / "world.yaml",
                     "name: small\n"
                     "duration_s: 120\n"
                     "landmarks: {generators: [{type: uniform, count: 60}]}\n"
                     "drive: {mode: explore}\n"
                     "scoring: {interval_s: 5}\n"
                     "estimators: {ekf: {}, seif_report: {}}\n");
  }

  void run_whole() { ASSERT_EQ(call(folder_, "run world.yaml --quiet --out whole").exit_code, 0); }

  /// Compares everything except times.
  void expect_as_whole(const fs::path& run) const {
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "whole")) {
      const std::string name = entry.path().filename().string();
      ++files;
      ASSERT_TRUE(fs::exists(run / name)) << name;
      if (name == "summary.json" || name.ends_with("_times.csv")) continue;
      EXPECT_EQ(read_file(run / name), read_file(entry.path())) << name;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(run), {}), static_cast<std::ptrdiff_t>(files));
    const auto hash_of = [](const fs::path& folder) {
      return nlohmann::json::parse(read_file(folder / "summary.json")).at("trajectory_hash");
    };
    EXPECT_EQ(hash_of(run), hash_of(folder_ / "whole"));
  }

  /// Scores and films the existing part, and then completes the run.
  void expect_useful(const std::string& run) {
    const Called scored = call(folder_, "score " + run + " --json");
    EXPECT_EQ(scored.exit_code, 0) << scored.errors;
    EXPECT_GT(nlohmann::json::parse(scored.output).at("updates"), 0);
    const Called filmed =
        call(folder_, "film " + run + " --at 0.5 --size 320x180 --quiet -o " + run + ".png");
    EXPECT_EQ(filmed.exit_code, 0) << filmed.errors;
    expect_completed(run);
  }

  void expect_completed(const std::string& run) {
    const Called resumed = call(folder_, "run --quiet --resume " + run);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
    expect_as_whole(folder_ / run);
  }

  /// Waits until the run has begun.
  void await_record(const std::string& run) const {
    while (!fs::exists(folder_ / run / "ekf_consistency.csv"))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  TemporaryFolder folder_;
};

TEST_F(Faults, AKillAtAnyMomentLeavesARunThatIsScoredFilmedAndCompleted) {
  run_whole();
  std::mt19937_64 random(20);
  const int kills = test::is_sanitized() ? 3 : 20;
  int useful = 0;
  for (int i = 0; i < kills; ++i) {
    const std::string run = "killed-" + std::to_string(i);
    Process process(folder_.path(), {"run", "world.yaml", "--quiet", "--out", run});
    await_record(run);
    std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution(0, 400)(random)));
    process.signal(SIGKILL);
    static_cast<void>(process.wait());
    if (!fs::exists(folder_ / run / "unfinished")) {  // the run has ended already
      expect_as_whole(folder_ / run);
      continue;
    }
    const Called scored = call(folder_, "score " + run + " --no-replay --json");
    if (scored.exit_code == 0) {
      ++useful;
      expect_useful(run);
    } else {
      EXPECT_EQ(scored.exit_code, 2);
      EXPECT_NE(scored.errors.find("cut off before anything was recorded"), std::string::npos)
          << scored.errors;
      expect_completed(run);
    }
  }
  EXPECT_GT(useful, 0);
}

TEST_F(Faults, ACompletionClearsAwayWhatAKillLeftHalfWritten) {
  run_whole();
  fs::copy(folder_ / "whole", folder_ / "cut");
  fs::remove(folder_ / "cut" / "summary.json");
  test::write_file(folder_ / "cut" / "summary.json.part", "{");
  test::write_file(folder_ / "cut" / "unfinished", "");
  expect_completed("cut");
}

TEST_F(Faults, ARequestToEndLeavesARunThatIsScoredFilmedAndCompleted) {
  run_whole();
  for (const int number : {SIGINT, SIGTERM}) {
    const std::string run = "ended-" + std::to_string(number);
    Process process(folder_.path(), {"run", "world.yaml", "--quiet", "--out", run});
    await_record(run);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    process.signal(number);
    EXPECT_EQ(process.wait().exit_code, 130);
    EXPECT_FALSE(fs::exists(folder_ / run / "unfinished"));
    expect_useful(run);
  }
}

TEST_F(Faults, ACompletionThatIsInterruptedChangesNothing) {
  run_whole();
  fs::copy(folder_ / "whole", folder_ / "cut");
  fs::remove(folder_ / "cut" / "summary.json");
  test::write_file(folder_ / "cut" / "unfinished", "");
  Process process(folder_.path(), {"run", "--quiet", "--resume", "cut"});
  await_record("cut/.resumed");
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  process.signal(SIGINT);
  EXPECT_EQ(process.wait().exit_code, 130);
  EXPECT_TRUE(fs::exists(folder_ / "cut" / "unfinished"));
  EXPECT_FALSE(fs::exists(folder_ / "cut" / ".resumed"));
  EXPECT_FALSE(fs::exists(folder_ / "cut" / "summary.json"));
  expect_completed("cut");
}

TEST_F(Faults, ARecordThatDoesNotComeAgainIsNotOverwritten) {
  run_whole();
  fs::copy(folder_ / "whole", folder_ / "other");
  test::write_file(folder_ / "other" / "unfinished", "");
  std::string record = read_file(folder_ / "other" / "odometry.csv");
  record.at(100) = '#';
  test::write_file(folder_ / "other" / "odometry.csv", record);
  const Called resumed = call(folder_, "run --resume other");
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_NE(resumed.errors.find("did not come again"), std::string::npos) << resumed.errors;
  EXPECT_EQ(read_file(folder_ / "other" / "odometry.csv"), record);
}

TEST_F(Faults, WhatIsCompleteOrNoRunIsNotResumed) {
  run_whole();
  EXPECT_EQ(call(folder_, "run --resume whole").output, "whole is complete\n");
  const Called no_run = call(folder_, "run --resume .");
  EXPECT_EQ(no_run.exit_code, 2) << "world.yaml alone is no run";
  EXPECT_EQ(call(folder_, "run --resume nowhere").exit_code, 2);
  EXPECT_EQ(call(folder_, "run --resume whole --seed 3").exit_code, 2);
}

/// Every table ends with a whole line.
void expect_whole_lines(const fs::path& run) {
  for (const fs::directory_entry& entry : fs::directory_iterator(run)) {
    const std::string text = read_file(entry.path());
    EXPECT_TRUE(text.empty() || text.back() == '\n') << entry.path();
  }
}

TEST_F(Faults, AFileThatMayNotGrowEndsTheRunWithAWordAndWhatThereIsIsGood) {
  run_whole();
  const Called run = call(folder_, "run world.yaml --quiet --out limited", "ulimit -f 200;");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.errors.find("cannot write limited/"), std::string::npos) << run.errors;
  expect_whole_lines(folder_ / "limited");
  EXPECT_FALSE(fs::exists(folder_ / "limited" / "summary.json"));
  expect_useful("limited");
}

/// A disk of this many bytes, if one can be mounted.
class SmallDisk {
 public:
  SmallDisk(fs::path folder, int bytes) : folder_(std::move(folder)) {
    fs::create_directories(folder_);
    const std::string options = "size=" + std::to_string(bytes);
    is_mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool is_mounted() const { return is_mounted_; }

 private:
  fs::path folder_;
  bool is_mounted_ = false;
};

TEST_F(Faults, AFullDiskEndsTheRunWithAWordAndWhatThereIsIsGood) {
  const SmallDisk disk(folder_ / "disk", 300'000);
  if (!disk.is_mounted()) GTEST_SKIP() << "no file system may be mounted here";
  run_whole();
  const Called run = call(folder_, "run world.yaml --quiet --out disk/run");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.errors.find("No space left on device"), std::string::npos) << run.errors;
  expect_whole_lines(folder_ / "disk" / "run");
  EXPECT_EQ(call(folder_, "score disk/run --json").exit_code, 0);
  fs::copy(folder_ / "disk" / "run", folder_ / "saved");
  expect_completed("saved");
}

TEST_F(Faults, AFilmForWhichThereIsNoRoomIsNoFilm) {
  const SmallDisk disk(folder_ / "disk", 100'000);
  if (!disk.is_mounted()) GTEST_SKIP() << "no file system may be mounted here";
  ASSERT_EQ(call(folder_, "run world.yaml --duration 10 --quiet --out run").exit_code, 0);
  const Called film = call(folder_, "film run --speed 1 --quiet -o disk/film.mp4");
  EXPECT_EQ(film.exit_code, 1);
  EXPECT_NE(film.errors.find("cannot write disk/film.mp4"), std::string::npos) << film.errors;
  EXPECT_TRUE(fs::is_empty(folder_ / "disk"));
}

TEST_F(Faults, AFilmHasItsNameWhenItIsWhole) {
  ASSERT_EQ(call(folder_, "run world.yaml --duration 10 --quiet --out run").exit_code, 0);
  Process process(folder_.path(), {"film", "run", "--speed", "0.1", "--quiet", "-o", "film.mp4"});
  while (!fs::exists(folder_ / "film.mp4.part")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait().exit_code, -1);
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4"));
}

TEST_F(Faults, AnOutputFolderThatGoesAwayEndsTheRunWithAWord) {
  Process process(folder_.path(), {"run", "world.yaml", "--quiet", "--out", "gone"});
  await_record("gone");
  // Removed in one step: files that are made while the folder is emptied would keep it alive.
  fs::rename(folder_ / "gone", folder_ / "aside");
  fs::remove_all(folder_ / "aside");
  EXPECT_EQ(process.wait().exit_code, 1);
  EXPECT_NE(read_file(folder_ / "errors").find("cannot write gone/"), std::string::npos);
}

TEST_F(Faults, AnOutputFolderThatCannotBeMadeIsBadInput) {
  const Called run = call(folder_, "run world.yaml --out /proc/nothing");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.errors.find("/proc/nothing: cannot be created"), std::string::npos) << run.errors;
}

TEST_F(Faults, AHomeThatCannotBeWrittenDoesNoHarm) {
  const std::string home = "HOME=/proc XDG_CACHE_HOME=/proc XDG_CONFIG_HOME=/proc";
  const Called run = call(
      folder_, "run world.yaml --duration 5 --film --set 'film.size_px=[320, 180]' --quiet --out run", home);
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_TRUE(fs::exists(folder_ / "run" / "film.mp4"));
}

TEST_F(Faults, AReaderThatGoesAwayCostsNothingOfTheRun) {
  test::call_program(folder_, "{ '" SEIFBED_PROGRAM
                              "' run world.yaml --duration 10 --film --set 'film.size_px=[320, 180]' "
                              "--json --out run 2>words; echo $? >code; } | true");
  EXPECT_EQ(read_file(folder_ / "code"), "1\n");
  EXPECT_TRUE(read_file(folder_ / "words").starts_with("seifbed: cannot write to the standard output\n"));
  EXPECT_TRUE(fs::exists(folder_ / "run" / "summary.json"));
  EXPECT_TRUE(fs::exists(folder_ / "run" / "film.mp4"));
  EXPECT_FALSE(fs::exists(folder_ / "run" / "unfinished"));
}

TEST_F(Faults, AMissingFfmpegIsToldBeforeTheRun) {
  const Called run = call(folder_, "run world.yaml --film --quiet --out run", "PATH=/nowhere");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.errors.find("ffmpeg is missing: install ffmpeg"), std::string::npos) << run.errors;
  EXPECT_FALSE(fs::exists(folder_ / "run" / "odometry.csv"));
}

}  // namespace
}  // namespace harness
