#include "harness/run/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <variant>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {
namespace {

using test::choice;
using test::read_file;
using test::replay;
using test::run_live;
using test::small_world;

std::string first_line(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  return text.substr(0, text.find('\n'));
}

TEST(Run, WritesTheDocumentedFiles) {
  const TemporaryFolder folder;
  const RunResult result = run_live(small_world(), folder / "run");
  EXPECT_EQ(exit_code(result), 0) << result.error;
  const std::vector<std::pair<const char*, const char*>> headers = {
      {"odometry.csv", "t,dx,dy,dtheta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt"},
      {"observations.csv", "t,landmark,range,bearing,cov_rr,cov_rb,cov_bb"},
      {"truth.csv", "t,x,y,theta,left_wheel,right_wheel"},
      {"landmarks.csv", "landmark,x,y,radius"},
      {"ekf_map.csv", "landmark,x,y,cov_xx,cov_xy,cov_yy"},
      {"ekf_steps.csv",
       "t,error_x,error_y,error_theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,blocks_touched,active_"
       "landmarks,links,relocations,mean_residual,anchoring,gated,innovation,innovation_degrees,weakened"},
      {"ekf_times.csv", "t,update,motion,measurement,sparsification,mean_recovery"},
      {"ekf_consistency.csv", "t,nees_pose,nees_landmark,landmarks_scored,landmarks_mapped,memory_bytes"}};
  for (const auto& [file, header] : headers) EXPECT_EQ(first_line(folder / "run" / file), header) << file;
  for (const char* file :
       {"log.yaml", "truth.tum", "odometry.tum", "ekf.tum", "seif_report.tum", "summary.json"})
    EXPECT_FALSE(read_file(folder / "run" / file).empty()) << file;
  EXPECT_FALSE(std::filesystem::exists(folder / "run" / "observations_true_ids.csv"));
  std::istringstream pose(first_line(folder / "run" / "truth.tum"));
  const std::vector<double> numbers{std::istream_iterator<double>(pose), {}};
  EXPECT_EQ(numbers.size(), 8U) << "t x y z and a quaternion";
}

TEST(Run, TheSameSeedGivesTheSameBitsAndAnotherSeedOthers) {
  const TemporaryFolder folder;
  worlds::World world = small_world();
  const std::string hash = run_live(world, folder / "a").summary.trajectory_hash;
  EXPECT_EQ(run_live(world, folder / "b").summary.trajectory_hash, hash);
  world.seed = 4;
  EXPECT_NE(run_live(world, folder / "c").summary.trajectory_hash, hash);
}

TEST(Run, AReplayGivesTheSameBytesButForTimes) {
  const TemporaryFolder folder;
  worlds::World world = small_world();
  world.landmark_sensor.false_detections = 0.2;
  world.landmark_sensor.rate = 7;  // not in step with the odometry
  world.estimators.front().odometry_sd_factor = 2.0;
  world.estimators.back().observation_sd_factor = 0.5;
  const RunResult live = run_live(world, folder / "live");
  const RunResult replayed = replay(world, folder / "live", folder / "replay");
  EXPECT_EQ(replayed.summary.trajectory_hash, live.summary.trajectory_hash);
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "live")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with("_times.csv") || name == "summary.json") continue;
    EXPECT_EQ(read_file(folder / "replay" / name), read_file(entry.path())) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 16);  // eight of the log and its trajectories, four of each estimator
}

// It is scored like any other run, each time the same, and a replay gives the estimates of the live run.
TEST(Run, InTheKinematicEngineIsARunLikeAnyOther) {
  const TemporaryFolder folder;
  worlds::World world = small_world();
  const std::string in_bullet = run_live(world, folder / "bullet").summary.trajectory_hash;
  world.physics.engine = worlds::Engine::kinematic;
  const RunResult result = run_live(world, folder / "live");
  EXPECT_EQ(exit_code(result), 0) << result.error;
  EXPECT_EQ(result.summary.updates, 100);
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_EQ(score.landmarks_mapped, 12);
    EXPECT_LT(score.landmarks.rmse.value(), 0.5);
    EXPECT_TRUE(score.nees_pose);
  }
  const std::string& hash = result.summary.trajectory_hash;
  EXPECT_NE(hash, in_bullet);
  EXPECT_EQ(run_live(world, folder / "again").summary.trajectory_hash, hash);
  EXPECT_EQ(replay(world, folder / "live", folder / "replay").summary.trajectory_hash, hash);
  for (const char* file : {"ekf.tum", "ekf_steps.csv", "seif_report_map.csv"})
    EXPECT_EQ(read_file(folder / "replay" / file), read_file(folder / "live" / file)) << file;
}

TEST(Run, TheSummaryHasEveryKey) {
  const TemporaryFolder folder;
  const RunResult result = run_live(small_world(), folder / "run");
  const nlohmann::json summary = nlohmann::json::parse(read_file(folder / "run" / "summary.json"));
  for (const char* key : {"world", "seed", "duration_s", "updates", "trajectory_hash", "realtime_factor"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary["updates"], 100);
  EXPECT_EQ(summary["duration_s"], 20.0);
  EXPECT_LT(summary["odometry"]["ate_rmse_m"].get<double>(), 1.0);
  for (const char* name : {"ekf", "seif_report"}) {
    const nlohmann::json& estimator = summary["estimators"][name];
    for (const char* key :
         {"landmarks_mapped", "landmark_rmse_m", "landmark_rmse_aligned_m", "ate_rmse_m", "rpe_trans_m",
          "rpe_rot_rad", "nees_pose", "nees_landmark", "links", "active_max", "memory_bytes"})
      EXPECT_TRUE(estimator[key].is_number()) << name << ' ' << key;
    for (const char* key : {"p50", "p95", "p99", "max"}) {
      EXPECT_TRUE(estimator["update_us"][key].is_number()) << key;
      EXPECT_TRUE(estimator["blocks_touched"][key].is_number()) << key;
    }
    EXPECT_LT(estimator["landmark_rmse_m"], 0.5);
  }
}

TEST(Run, TheScoreIsAFunctionOfTheFolder) {
  const TemporaryFolder folder;
  const RunResult result = run_live(small_world(), folder / "run");
  const std::vector<std::string> names = {"ekf", "seif_report"};
  const RunScore again = score_folder(folder / "run", names, small_world().scoring.rpe_interval);
  EXPECT_EQ(again.estimators[0].trajectory.rmse, result.summary.score.estimators[0].trajectory.rmse);
  EXPECT_EQ(again.estimators[1].nees_landmark, result.summary.score.estimators[1].nees_landmark);
  EXPECT_EQ(again.estimators[1].update_us->p99, result.summary.score.estimators[1].update_us->p99);
}

TEST(Run, SteeringByAnEstimateDrivesAnotherPathThanByTheTruth) {
  const TemporaryFolder folder;
  worlds::World world = small_world();
  run_live(world, folder / "truth");
  for (const char* pose_from : {"odometry", "ekf", "seif_report"}) {
    world.drive.pose_from = pose_from;
    const RunResult result = run_live(world, folder / pose_from);
    EXPECT_EQ(exit_code(result), 0) << result.error;
    EXPECT_NE(read_file(folder / pose_from / "truth.csv"), read_file(folder / "truth" / "truth.csv"))
        << pose_from;
  }
}

TEST(Run, AnEstimatorThatFailsIsTakenOutAndTheOthersGoOn) {
  const TemporaryFolder folder;
  worlds::World world = small_world();
  const std::string ekf_alone = run_live(world, folder / "a").summary.trajectory_hash;
  world.estimators.push_back(choice("dead_reckoning"));
  world.estimators.back().options["fail_after_scans"] = std::int64_t{10};
  const RunResult result = run_live(world, folder / "b");
  EXPECT_EQ(exit_code(result), 1);
  EXPECT_EQ(result.summary.updates, 100);
  EXPECT_EQ(result.summary.failures, (std::vector<std::string>{"", "", "at 2 s: gave up"}));
  EXPECT_EQ(read_file(folder / "b" / "ekf.tum"), read_file(folder / "a" / "ekf.tum"));
  EXPECT_NE(scoreboard(result.summary).find("dead_reckoning failed at 2 s: gave up"), std::string::npos);
}

TEST(Run, EndsWhenTheEstimatorThatSteersFails) {
  const TemporaryFolder folder;
  worlds::World world = small_world();
  world.estimators.push_back(choice("dead_reckoning"));
  world.estimators.back().options["fail_after_scans"] = std::int64_t{10};
  world.drive.pose_from = "dead_reckoning";
  const RunResult result = run_live(world, folder / "run");
  EXPECT_EQ(exit_code(result), 1);
  EXPECT_EQ(result.summary.updates, 10);
  EXPECT_NE(result.error.find("dead_reckoning steers and has failed"), std::string::npos) << result.error;
}

/// Raises a signal in the middle of a stream.
class InterruptedStream final : public Stream {
 public:
  InterruptedStream(Stream& stream, int events) : stream_(stream), left_(events) {}
  bool next(Event& event) override {
    if (--left_ == 0) std::raise(SIGINT);
    return stream_.next(event);
  }

 private:
  Stream& stream_;
  int left_;
};

TEST(Run, AnInterruptLeavesAScoredFolderThatReplays) {
  const TemporaryFolder folder;
  const worlds::World world = small_world();
  std::filesystem::create_directories(folder / "run");
  Believers believers;
  SimulatedStream simulated(world, {});
  believers.estimators =
      make_estimators(test::test_registry(), world.estimators, simulated.description(), world.seed);
  InterruptedStream stream(simulated, 250);
  const RunPlan plan{folder / "run", world.name, world.seed, world.scoring, world.duration, true};
  const RunResult result = execute(stream, simulated.description(), believers, plan);
  EXPECT_EQ(exit_code(result), 130);
  EXPECT_TRUE(result.summary.interrupted);
  EXPECT_EQ(result.summary.updates, 50);
  EXPECT_TRUE(result.summary.score.estimators[0].landmarks.rmse);
  EXPECT_EQ(replay(world, folder / "run", folder / "again").summary.trajectory_hash,
            result.summary.trajectory_hash);
}

TEST(Run, ALogThatBreaksOffIsScoredUpToThere) {
  const TemporaryFolder folder;
  const worlds::World world = small_world();
  run_live(world, folder / "run");
  std::string odometry = read_file(folder / "run" / "odometry.csv");
  odometry.resize(odometry.size() / 2);
  test::write_file(folder / "run" / "odometry.csv", odometry + "garbage\n");
  const RunResult result = replay(world, folder / "run", folder / "again");
  EXPECT_EQ(exit_code(result), 2);
  EXPECT_NE(result.error.find("odometry.csv:"), std::string::npos);
  EXPECT_GT(result.summary.updates, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "again" / "summary.json"));
}

TEST(Run, WithoutTruthScoresAreNull) {
  const TemporaryFolder folder;
  const worlds::World world = small_world();
  run_live(world, folder / "run");
  for (const char* file : {"truth.csv", "landmarks.csv"}) std::filesystem::remove(folder / "run" / file);
  const RunResult result = replay(world, folder / "run", folder / "again");
  EXPECT_EQ(exit_code(result), 0) << result.error;
  EXPECT_EQ(read_file(folder / "again" / "ekf.tum"), read_file(folder / "run" / "ekf.tum"));
  const nlohmann::json summary = nlohmann::json::parse(read_file(folder / "again" / "summary.json"));
  EXPECT_TRUE(summary["estimators"]["ekf"]["ate_rmse_m"].is_null());
  EXPECT_TRUE(summary["estimators"]["ekf"]["nees_pose"].is_null());
  EXPECT_EQ(summary["estimators"]["ekf"]["improper_beliefs"], 0);
}

TEST(Run, AFolderThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(run_live(small_world(), "/proc/seifbed"), std::exception);
}

TEST(Run, TheScoreboardFitsATerminal) {
  const TemporaryFolder folder;
  worlds::World world = small_world();
  for (const char* name : {"careful_ekf_two", "careful_ekf_six", "one_more_filter", "another_filter"}) {
    world.estimators.push_back(choice("ekf"));
    world.estimators.back().name = name;
  }
  std::istringstream text(scoreboard(run_live(world, folder / "run").summary));
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 110U) << line;
}

TEST(MakeEstimators, RefusesNamesThatItsFilesCannotBear) {
  for (const char* name : {"truth", "odometry", "../x", "a/b", ""}) {
    worlds::EstimatorChoice bad = choice("ekf");
    bad.name = name;
    EXPECT_THROW(make_estimators(test::test_registry(), std::vector{bad}, {}, 1), BadInput) << name;
  }
  const std::vector twice = {choice("dead_reckoning"), choice("dead_reckoning")};
  EXPECT_THROW(make_estimators(test::test_registry(), twice, {}, 1), BadInput);
}

TEST(SimulatedStream, EventsComeAtTheirRatesWithOdometryFirst) {
  worlds::World world = small_world();
  world.duration = 2.0;
  SimulatedStream stream(world, {});
  std::vector<double> odometry;
  std::vector<double> scans;
  Event event;
  while (stream.next(event)) {
    if (const auto* reading = std::get_if<OdometryEvent>(&event)) {
      odometry.push_back(reading->odometry.t);
      EXPECT_TRUE(scans.empty() || scans.back() < odometry.back());
    } else {
      scans.push_back(std::get<ScanEvent>(event).scan.t);
      EXPECT_GE(scans.back(), odometry.back());
    }
  }
  ASSERT_EQ(odometry.size(), 40U);
  ASSERT_EQ(scans.size(), 10U);
  EXPECT_EQ(odometry[2], 36.0 / 240.0);
  EXPECT_EQ(scans.back(), 2.0);
}

// Encoders without error, read at every step, give exactly the simulated pose: the arcs of the engine and of
// the encoders' model are implemented separately.
TEST(SimulatedStream, KinematicMotionIsWhatPerfectEncodersReckon) {
  worlds::World world = small_world();
  world.physics.engine = worlds::Engine::kinematic;
  world.encoders.rate = world.physics.step_rate;
  world.encoders.ticks_per_revolution = 0;
  world.encoders.distance_sd = 0.0;
  SimulatedStream stream(world, {});
  seif::Pose2 reckoned{world.robot.start.position.x(), world.robot.start.position.y(),
                       world.robot.start.heading};
  double driven = 0.0;  // [m]
  Event event;
  while (stream.next(event)) {
    const auto* reading = std::get_if<OdometryEvent>(&event);
    if (reading == nullptr) continue;
    const seif::Pose2& step = reading->odometry.T_previous_current;
    reckoned = reckoned * step;
    driven += std::hypot(step.x, step.y);
    const seif::Pose2& truth = reading->truth->T_world_robot;
    ASSERT_NEAR(reckoned.x, truth.x, 1e-11);
    ASSERT_NEAR(reckoned.y, truth.y, 1e-11);
    ASSERT_NEAR(seif::wrap_angle(reckoned.theta - truth.theta), 0.0, 1e-11);
  }
  EXPECT_GT(driven, 8.0);
}

TEST(SimulatedStream, MayWithholdIdsAndKeepsTheTrueOnesForTheScore) {
  worlds::World world = small_world();
  world.landmark_sensor.ids = worlds::LandmarkIds::hidden;
  SimulatedStream stream(world, {});
  EXPECT_FALSE(stream.description().known_association);
  EXPECT_TRUE(stream.description().has_true_ids);
  int seen = 0;
  Event event;
  while (stream.next(event)) {
    const auto* scan = std::get_if<ScanEvent>(&event);
    if (scan == nullptr) continue;
    for (std::size_t i = 0; i < scan->true_ids.size(); ++i) {
      EXPECT_EQ(scan->scan.observations.at(i).landmark, seif::no_landmark);
      EXPECT_NE(scan->true_ids[i], seif::no_landmark);
      ++seen;
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(SimulatedStream, FalseDetectionsHaveIdsThatNoLandmarkHas) {
  worlds::World world = small_world();
  world.landmark_sensor.false_detections = 2.0;
  SimulatedStream stream(world, {});
  EXPECT_TRUE(stream.description().has_true_ids);
  int false_ones = 0;
  Event event;
  while (stream.next(event)) {
    const auto* scan = std::get_if<ScanEvent>(&event);
    if (scan == nullptr) continue;
    ASSERT_EQ(scan->true_ids.size(), scan->scan.observations.size());
    for (std::size_t i = 0; i < scan->true_ids.size(); ++i) {
      const bool is_false = scan->true_ids[i] == seif::no_landmark;
      EXPECT_EQ(is_false, scan->scan.observations[i].landmark >= 12);
      false_ones += is_false ? 1 : 0;
    }
  }
  EXPECT_GT(false_ones, 100);  // 200 are expected
}

}  // namespace
}  // namespace harness
