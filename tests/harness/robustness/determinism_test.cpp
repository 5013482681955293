// The same world, seed and build give the same bits: in separate processes, beside other processes, and with or
// without a recorder. Other cases are in other tests: two runs in one process in run_test, the number of jobs
// of a sweep or comparison in sweep_command_test and command_line_test, live and recorded films in film_test.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <list>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"
#include "harness/run/prepared_run.hpp"
#include "limited_call.hpp"

namespace harness {
namespace {

using test::call;
using test::read_file;

/// A world with something of everything: physics with contacts, random numbers, every filter that draws none,
/// faults.
constexpr const char* world_text =
    "name: small\n"
    "duration_s: 25\n"
    "landmarks: {generators: [{type: uniform, count: 30, region: {min_m: [-8, -8], max_m: [8, 8]}}]}\n"
    "obstacles: {boxes: [{x_m: 0, y_m: 0, size_m: [2, 1], heading_deg: 30}]}\n"
    "drive: {mode: loop, waypoints_m: [[3, 3], [-3, 3], [-3, -3], [3, -3]]}\n"
    "robot: {start: {x_m: 3, y_m: -3, heading_deg: 90}}\n"
    "sensors: {landmark_sensor: {miss_probability: 0.1, false_detections_per_scan: 0.2}}\n"
    "faults:\n"
    "  - {kind: bad_observation, at_s: 8}\n"
    "  - {kind: kidnapping, at_s: 15, x_m: -3, y_m: -2, heading_deg: 10}\n"
    "estimators: {ekf: {}, seif: {}, seif_report: {}, eseif: {}}\n";

/// The files of a run that contain no times, and its summary without times.
std::map<std::string, std::string> bytes_of(const std::filesystem::path& run) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : std::filesystem::directory_iterator(run)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with("_times.csv") || name == "summary.json" || name == "film.mp4") continue;
    bytes[name] = read_file(entry.path());
  }
  return bytes;
}

class Determinism : public testing::Test {
 protected:
  Determinism() {
    test::write_file(folder_ / "world.yaml", world_text);
    EXPECT_EQ(call(folder_, "run world.yaml --quiet --out first").exit_code, 0);
    first_ = bytes_of(folder_ / "first");
    EXPECT_GE(first_.size(), 20U);
  }

  void expect_the_same(const std::string& run) const {
    const std::map<std::string, std::string> again = bytes_of(folder_ / run);
    EXPECT_EQ(again.size(), first_.size());
    for (const auto& [name, bytes] : first_) EXPECT_TRUE(again.at(name) == bytes) << run << '/' << name;
  }

  TemporaryFolder folder_;
  std::map<std::string, std::string> first_;
};

TEST_F(Determinism, TwoProcessesGiveTheSameBytes) {
  EXPECT_EQ(call(folder_, "run world.yaml --quiet --out second").exit_code, 0);
  expect_the_same("second");
}

TEST_F(Determinism, ThePlaceInMemoryAndTheEnvironmentDoNotMatter) {
  const std::string padding(10'000, 'x');  // shifts the stack
  EXPECT_EQ(call(folder_, "run world.yaml --quiet --out padded",
                 "PADDING=" + padding + " LC_ALL=de_DE.UTF-8 TZ=Asia/Tokyo MALLOC_PERTURB_=165")
                .exit_code,
            0);
  expect_the_same("padded");
}

// Eigen sums up in another order where a vector begins elsewhere in a cache line. Without its caches the heap puts most
// vectors elsewhere; a kilometre into the orchard a last bit used to differ then.
TEST_F(Determinism, WhereTheHeapPutsThingsDoesNotMatter) {
  const std::string orchard = std::string(
      "run " SEIFBED_SOURCE_DIR "/worlds/orchard.yaml --duration 160 --set estimators='{seif: {}}' --quiet");
  ASSERT_EQ(call(folder_, orchard + " --out orchard").exit_code, 0);
  ASSERT_EQ(
      call(folder_, orchard + " --out elsewhere", "GLIBC_TUNABLES=glibc.malloc.tcache_count=0").exit_code, 0);
  EXPECT_EQ(trajectory_hash(folder_ / "elsewhere"), trajectory_hash(folder_ / "orchard"));
}

// With busy threads, and three more runs at the same time.
TEST_F(Determinism, AMachineUnderLoadGivesTheSameBytes) {
  std::atomic<bool> done = false;
  std::vector<std::jthread> burners;
  for (int i = 0; i < 4; ++i)
    burners.emplace_back([&] {
      while (!done) {
      }
    });
  {
    std::list<test::Process> runs;
    for (const char* out : {"a", "b", "c"})
      runs.emplace_back(folder_.path(),
                        std::vector<std::string>{"run", "world.yaml", "--quiet", "--out", out});
    for (test::Process& run : runs) EXPECT_EQ(run.wait().exit_code, 0);
  }
  done = true;
  for (const char* out : {"a", "b", "c"}) expect_the_same(out);
}

TEST_F(Determinism, AFilmBesideItChangesNothing) {
  const test::Called filmed = call(
      folder_, "run world.yaml --quiet --out filmed --film --set film.fps=2 --set 'film.size_px=[160, 120]'");
  if (filmed.exit_code != 0 && (filmed.errors.find("OSMesa") != std::string::npos ||
                                filmed.errors.find("ffmpeg") != std::string::npos))
    GTEST_SKIP() << filmed.errors;
  EXPECT_EQ(filmed.exit_code, 0) << filmed.errors;
  std::map<std::string, std::string> again = bytes_of(folder_ / "filmed");
  for (const auto& [name, bytes] : first_) {
    if (name == "world.yaml") continue;
    EXPECT_TRUE(again.at(name) == bytes) << name;
  }
}

/// Stores the last pose of each estimator.
class LastPoses final : public RunListener {
 public:
  void odometry(const OdometryEvent&) override {}
  void scan(const ScanEvent&) override {}
  void update(std::size_t estimator, const UpdateRecord& record) override {
    poses[estimator] = record.est_pose;
  }
  std::map<std::size_t, seif::Pose2> poses;
};

// A loop without a recorder gives the same estimates.
TEST(DeterminismOfALoop, WithoutARecordIsThatWithOne) {
  worlds::World world = test::small_world();
  world.estimators = {test::choice("ekf"), test::choice("seif")};
  LastPoses bare;
  PreparedRun run = prepare_run(world, test::test_registry());
  LiveLoop loop(*run.stream, *run.believers, {&bare}, *run.log, world.scoring);
  const std::atomic<bool> stop = false;
  loop.run(stop, {});

  LastPoses recorded;
  PreparedRun again = prepare_run(world, test::test_registry());
  execute_in_passing(again, &recorded);
  ASSERT_EQ(bare.poses.size(), 2U);
  for (const auto& [estimator, pose] : bare.poses) {
    EXPECT_EQ(pose.x, recorded.poses.at(estimator).x);
    EXPECT_EQ(pose.y, recorded.poses.at(estimator).y);
    EXPECT_EQ(pose.theta, recorded.poses.at(estimator).theta);
  }
}

}  // namespace
}  // namespace harness
