// Worlds in which things appear and somebody takes the wheel: their run folders can be run and replayed again.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::read_file;

constexpr const char* world_text =
    "name: meddled\n"
    "duration_s: 12\n"
    "landmarks: {generators: [{type: uniform, count: 20, region: {min_m: [-8, -8], max_m: [8, 8]}}]}\n"
    "drive: {mode: loop, waypoints_m: [[3, 3], [-3, 3], [-3, -3], [3, -3]], takeover_file: hands/wheel.csv}\n"
    "robot: {start: {x_m: 3, y_m: -3, heading_deg: 90}}\n"
    "faults:\n"
    "  - {kind: landmark, at_s: 9, x_m: 0.5, y_m: 0.5}\n"
    "  - {kind: landmark, at_s: 2, x_m: 0.25, y_m: -0.25, radius_m: 0.2}\n"
    "  - {kind: wall, at_s: 3, points_m: [[-1, 4], [4, 4.5]]}\n"
    "  - {kind: ice, at_s: 4, min_m: [-9, 0], max_m: [9, 9], friction: 0.03}\n"
    "estimators: {ekf: {}, seif: {}}\n";

constexpr const char* wheel = "t,v,omega\n5,0.2,0.30000000000000004\n6.5,,\n7.0041666666666664,-0.1,0\n";

/// The files of a run that contain no times.
std::map<std::string, std::string> bytes_of(const std::filesystem::path& run) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : std::filesystem::directory_iterator(run)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with("_times.csv") && name != "summary.json") bytes[name] = read_file(entry.path());
  }
  return bytes;
}

class MeddledRun : public testing::Test {
 protected:
  MeddledRun() {
    std::filesystem::create_directory(folder_ / "hands");
    test::write_file(folder_ / "world.yaml", world_text);
    test::write_file(folder_ / "hands" / "wheel.csv", wheel);
  }

  TemporaryFolder folder_;
};

TEST_F(MeddledRun, CanBeRunAgainFromItsFolderAlone) {
  const test::Called first = call(folder_, "run world.yaml --quiet --out first");
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_EQ(read_file(folder_ / "first" / "takeover.csv"), wheel);
  std::filesystem::remove_all(folder_ / "hands");
  const test::Called second = call(folder_, "run first/world.yaml --quiet --out second");
  ASSERT_EQ(second.exit_code, 0) << second.errors;
  EXPECT_EQ(bytes_of(folder_ / "second"), bytes_of(folder_ / "first"));
  const test::Called replayed = call(folder_, "replay first --quiet --out third");
  ASSERT_EQ(replayed.exit_code, 0) << replayed.errors;
  EXPECT_EQ(bytes_of(folder_ / "third"), bytes_of(folder_ / "first"));
}

TEST_F(MeddledRun, KnowsTheLandmarksThatAppearedWithTheirIds) {
  ASSERT_EQ(call(folder_, "run world.yaml --quiet --out run").exit_code, 0);
  const std::string landmarks = read_file(folder_ / "run" / "landmarks.csv");
  EXPECT_NE(landmarks.find("\n20,0.25,-0.25,0.2\n21,0.5,0.5,0.1\n"), std::string::npos) << landmarks;
  EXPECT_NE(read_file(folder_ / "run" / "ekf_map.csv").find("\n20,"), std::string::npos);
  EXPECT_NE(read_file(folder_ / "run" / "seif_map.csv").find("\n20,"), std::string::npos);
}

TEST_F(MeddledRun, ThatPutsAWallOnTheRobotSaysSoAndFails) {
  const test::Called called =
      call(folder_, "run world.yaml --quiet --out run --set 'faults.2.points_m=[[2, -1], [4, -1]]'");
  EXPECT_NE(called.exit_code, 0);
  EXPECT_NE(called.errors.find("at 3 s: the wall of the world's faults cannot appear: there is no room"),
            std::string::npos)
      << called.errors;
}

TEST_F(MeddledRun, WithAWrongRowIsRefusedWithItsLine) {
  test::write_file(folder_ / "hands" / "wheel.csv", "t,v,omega\n5,0.2,0\n4,,\n");
  const test::Called called = call(folder_, "run world.yaml --quiet --out run");
  EXPECT_NE(called.exit_code, 0);
  EXPECT_NE(called.errors.find("wheel.csv:3:1: the time must be"), std::string::npos) << called.errors;
}

}  // namespace
}  // namespace harness
