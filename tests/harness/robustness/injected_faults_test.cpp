// Injected faults: how the filters react to each, and what a run reports about it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {
namespace {

using test::choice;
using test::read_file;
using test::run_live;
using worlds::Fault;
using worlds::FaultKind;

constexpr double at = 12.0;  // [s] of each fault

worlds::EstimatorChoice gated(const std::string& type) {
  worlds::EstimatorChoice gated = choice(type);
  gated.name = type + "_gated";
  gated.options["gate"] = 25.0;
  return gated;
}

/// `ekf` and `seif`, and both with a gate.
worlds::World world_with(const std::vector<Fault>& faults) {
  worlds::World world = test::small_world();
  world.duration = 30.0;
  world.physics.engine = worlds::Engine::kinematic;
  world.encoders.calibrated = true;
  world.estimators = {choice("ekf"), choice("seif"), gated("ekf"), gated("seif")};
  world.faults = faults;
  return world;
}

Fault kidnapping() { return {.kind = FaultKind::kidnapping, .at = at, .to = {{-2.0, -1.0}, -2.0}}; }

const EstimatorScore& score_of(const RunResult& result, const std::string& name) {
  return *std::ranges::find(result.summary.score.estimators, name, &EstimatorScore::name);
}

void expect_nothing_infinite_in(const std::filesystem::path& run) {
  for (const auto& entry : std::filesystem::directory_iterator(run)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".csv") && !name.ends_with(".tum")) continue;
    const std::string text = read_file(entry.path());
    const std::size_t body = name.ends_with(".csv") ? text.find('\n') : 0;
    EXPECT_EQ(text.find("nan", body), std::string::npos) << name;
    EXPECT_EQ(text.find("inf", body), std::string::npos) << name;
  }
}

TEST(InjectedFaults, WithoutAnyNothingIsTold) {
  const TemporaryFolder folder;
  const RunResult result = run_live(world_with({}), folder / "run");
  EXPECT_EQ(exit_code(result), 0);
  EXPECT_TRUE(result.summary.left_out.empty());
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_FALSE(score.diverged_t) << score.name;
    EXPECT_FALSE(score.diverged_nees_t) << score.name;
    EXPECT_GT(score.worst_nis, 0.0) << score.name;
  }
  EXPECT_EQ(LogStream(folder / "run").description().max_range, 8.0);  // so a replay ignores the same ones
  const std::string board = scoreboard(result.summary);
  EXPECT_EQ(board.find("diverged"), std::string::npos);
  EXPECT_EQ(board.find("Not given"), std::string::npos);
}

class BadObservation : public testing::TestWithParam<worlds::BadValue> {};
INSTANTIATE_TEST_SUITE_P(Values, BadObservation,
                         testing::Values(worlds::BadValue::nan, worlds::BadValue::infinite,
                                         worlds::BadValue::absurd));

TEST_P(BadObservation, IsLeftOutCountedAndTold) {
  const TemporaryFolder folder;
  const worlds::World world =
      world_with({{.kind = FaultKind::bad_observation, .at = at, .value = GetParam(), .to = {}}});
  const RunResult result = run_live(world, folder / "run");
  EXPECT_EQ(exit_code(result), 0);
  ASSERT_EQ(result.summary.left_out.size(), 1U);
  const bool is_absurd = GetParam() == worlds::BadValue::absurd;
  EXPECT_EQ(result.summary.left_out.front().first,
            is_absurd ? "observations_out_of_range" : "observations_not_finite");
  EXPECT_EQ(result.summary.left_out.front().second, 1);
  EXPECT_EQ(result.summary.left_out_t, at);
  EXPECT_NE(scoreboard(result.summary).find("Not given to the estimators"), std::string::npos);
  EXPECT_NE(read_file(folder / "run" / "summary.json").find("\"left_out\""), std::string::npos);
  expect_nothing_infinite_in(folder / "run");
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_LT(score.landmarks.rmse_aligned, 0.05) << score.name;
    EXPECT_FALSE(score.diverged_t) << score.name;
  }
  const RunResult replayed = test::replay(world, folder / "run", folder / "replay");
  EXPECT_EQ(replayed.summary.trajectory_hash, result.summary.trajectory_hash);
}

TEST(Outlier, OfAHundredSigmaBendsWhatHasNoGateAndIsToldOfThat) {
  const TemporaryFolder folder;
  const RunResult result =
      run_live(world_with({{.kind = FaultKind::outlier, .at = at, .size = 100.0, .to = {}}}), folder / "run");
  for (const std::string name : {"ekf", "seif"}) {
    const EstimatorScore& score = score_of(result, name);
    ASSERT_TRUE(score.diverged_t) << name;
    EXPECT_GE(*score.diverged_t, at) << name;
    EXPECT_LE(*score.diverged_t, at + 0.5) << name;
    EXPECT_NE(scoreboard(result.summary).find(name + " diverged at 12"), std::string::npos);
    const EstimatorScore& with_gate = score_of(result, name + "_gated");
    EXPECT_FALSE(with_gate.diverged_t) << name;
    EXPECT_GE(with_gate.gated, 1) << name;
    EXPECT_LT(with_gate.landmarks.rmse_aligned, 0.05) << name;
  }
  expect_nothing_infinite_in(folder / "run");
}

TEST(Outlier, OfTwoSigmaIsNoNews) {
  const TemporaryFolder folder;
  const RunResult result =
      run_live(world_with({{.kind = FaultKind::outlier, .at = at, .size = 2.0, .to = {}}}), folder / "run");
  for (const EstimatorScore& score : result.summary.score.estimators)
    EXPECT_FALSE(score.diverged_t) << score.name;
}

TEST(EncoderJump, IsOdometryThatTheInnovationsContradict) {
  const TemporaryFolder folder;
  worlds::World world = world_with({{.kind = FaultKind::encoder_jump,
                                     .at = at,
                                     .wheel = worlds::Wheel::right,
                                     .jump = std::numbers::pi,
                                     .to = {}}});
  for (worlds::EstimatorChoice& estimator : world.estimators) estimator.options["relocate"] = "never";
  const RunResult result = run_live(world, folder / "run");
  for (const EstimatorScore& score : result.summary.score.estimators) {
    ASSERT_TRUE(score.diverged_t) << score.name;
    EXPECT_GE(*score.diverged_t, at) << score.name;
    EXPECT_LE(*score.diverged_t, at + 2.5) << score.name;
  }
  // Half a turn of a wheel of 0.1 m with a track of 0.4 m, in one increment of the recorded odometry.
  LogStream log(folder / "run");
  double largest_turn = 0.0;
  for (Event event; log.next(event);) {
    const auto* odometry = std::get_if<OdometryEvent>(&event);
    if (odometry != nullptr)
      largest_turn = std::max(largest_turn, std::abs(odometry->odometry.T_previous_current.theta));
  }
  EXPECT_NEAR(largest_turn, 0.1 * std::numbers::pi / 0.4, 0.1);
  expect_nothing_infinite_in(folder / "run");
}

TEST(EncoderJump, IsForgottenByAFilterThatLooksForItsPlace) {
  const TemporaryFolder folder;
  const worlds::World world = world_with({{.kind = FaultKind::encoder_jump,
                                           .at = at,
                                           .wheel = worlds::Wheel::right,
                                           .jump = std::numbers::pi,
                                           .to = {}}});
  const RunResult result = run_live(world, folder / "run");
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_EQ(score.relocations, 1) << score.name;
    EXPECT_EQ(score.losses.found(), 1) << score.name;
    EXPECT_EQ(score.losses.found_wrongly(), 0) << score.name;
    EXPECT_FALSE(score.diverged_nees_t) << score.name;
    EXPECT_LT(score.landmarks.rmse_aligned, 0.05) << score.name;
  }
}

/// The times of one kind of event in a recorded run.
template <class Kind>
std::vector<double> times_in(const std::filesystem::path& run) {
  LogStream log(run);
  std::vector<double> times;
  for (Event event; log.next(event);) {
    if (!std::holds_alternative<Kind>(event)) continue;
    if constexpr (std::is_same_v<Kind, ScanEvent>) {
      times.push_back(std::get<ScanEvent>(event).scan.t);
    } else {
      times.push_back(std::get<OdometryEvent>(event).odometry.t);
    }
  }
  return times;
}

TEST(Silence, OfTheLandmarkSensorIsAGapThatRightFiltersBridge) {
  const TemporaryFolder folder;
  Fault silence{
      .kind = FaultKind::silence, .at = at, .sensor = worlds::FaultySensor::landmark_sensor, .to = {}};
  silence.duration = 10.0;
  const RunResult result = run_live(world_with({silence}), folder / "run");
  const std::vector<double> scans = times_in<ScanEvent>(folder / "run");
  EXPECT_EQ(std::ranges::count_if(scans, [](double t) { return t >= at && t < at + 10.0; }), 0);
  EXPECT_EQ(scans.size(), 100U);  // 5 Hz for 20 s
  EXPECT_EQ(times_in<OdometryEvent>(folder / "run").size(), 600U);
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_FALSE(score.diverged_t) << score.name;
    EXPECT_FALSE(score.diverged_nees_t) << score.name;
    EXPECT_LT(score.landmarks.rmse_aligned, 0.05) << score.name;
  }
}

// The encoders go on counting: the first increment after the gap contains everything.
TEST(Silence, OfTheEncodersEndsWithOneLongIncrement) {
  const TemporaryFolder folder;
  Fault silence{.kind = FaultKind::silence, .at = at, .sensor = worlds::FaultySensor::encoders, .to = {}};
  silence.duration = 1.0;
  run_live(world_with({silence}), folder / "run");
  const std::vector<double> increments = times_in<OdometryEvent>(folder / "run");
  EXPECT_EQ(increments.size(), 580U);  // 20 Hz, without one second
  const RunResult whole = run_live(world_with({}), folder / "whole");
  EXPECT_EQ(read_file(folder / "run" / "truth.tum").substr(0, 1000),
            read_file(folder / "whole" / "truth.tum").substr(0, 1000));
  EXPECT_EQ(times_in<ScanEvent>(folder / "run").size(), 150U);
}

class Kidnapping : public testing::TestWithParam<worlds::Engine> {};
INSTANTIATE_TEST_SUITE_P(Engines, Kidnapping,
                         testing::Values(worlds::Engine::bullet, worlds::Engine::kinematic),
                         [](const auto& engine) {
                           return engine.param == worlds::Engine::bullet ? "Bullet" : "Kinematic";
                         });

TEST_P(Kidnapping, IsToldWithinSecondsByFiltersThatDoNotLookForTheirPlace) {
  const TemporaryFolder folder;
  worlds::World world = world_with({kidnapping()});
  world.physics.engine = GetParam();
  for (worlds::EstimatorChoice& estimator : world.estimators) estimator.options["relocate"] = "never";
  const RunResult result = run_live(world, folder / "run");
  for (const EstimatorScore& score : result.summary.score.estimators) {
    ASSERT_TRUE(score.diverged_t) << score.name;
    EXPECT_GT(*score.diverged_t, at) << score.name;
    EXPECT_LE(*score.diverged_t, at + 3.0) << score.name;
    ASSERT_TRUE(score.diverged_nees_t) << score.name;
    EXPECT_LE(*score.diverged_nees_t, 15.0) << score.name;  // the next scoring time
  }
  const auto json = nlohmann::json::parse(read_file(folder / "run" / "summary.json"));
  EXPECT_EQ(json["estimators"]["seif"]["diverged_s"], score_of(result, "seif").diverged_t);
  EXPECT_NE(scoreboard(result.summary).find("seif diverged at"), std::string::npos);
  expect_nothing_infinite_in(folder / "run");
}

class Found : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Landmarks, Found, testing::Bool(),
                         [](const auto& named) { return named.param ? "WithNames" : "WithoutNames"; });

TEST_P(Found, IsTheRobotAfterAKidnappingAndTheMapStaysRight) {
  const TemporaryFolder folder;
  worlds::World world = world_with({kidnapping()});
  world.landmark_sensor.ids = GetParam() ? worlds::LandmarkIds::known : worlds::LandmarkIds::hidden;
  // Not on a ring, which looks the same from many places.
  for (std::size_t i = 0; i < world.landmarks.size(); ++i)
    world.landmarks[i].position *= 0.8 + 0.4 * std::sin(37.0 * static_cast<double>(i * i + 1));
  const RunResult result = run_live(world, folder / "run");
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_EQ(score.relocations, 1) << score.name;
    EXPECT_EQ(score.losses.count(), 1) << score.name;
    EXPECT_EQ(score.losses.found(), 1) << score.name;
    EXPECT_EQ(score.losses.found_wrongly(), 0) << score.name;
    EXPECT_FALSE(score.diverged_nees_t) << score.name;
    EXPECT_LT(score.landmarks.rmse_aligned, 0.05) << score.name;
    EXPECT_LT(score.nees_pose_final, 10.0) << score.name;
  }
}

TEST_P(Kidnapping, MovesTheTruthAndNotTheWheels) {
  const TemporaryFolder folder;
  worlds::World world = world_with({kidnapping()});
  world.physics.engine = GetParam();
  run_live(world, folder / "run");
  LogStream log(folder / "run");
  double longest_way = 0.0;
  double longest_roll = 0.0;
  std::optional<TruePose> before;
  for (Event event; log.next(event);) {
    const auto* odometry = std::get_if<OdometryEvent>(&event);
    if (odometry == nullptr) continue;
    const TruePose& now = *odometry->truth;
    if (before) {
      const seif::Pose2 moved = inverse(before->T_world_robot) * now.T_world_robot;
      longest_way = std::max(longest_way, std::hypot(moved.x, moved.y));
      longest_roll = std::max(longest_roll, std::abs(now.left_wheel - before->left_wheel));
    }
    before = now;
  }
  EXPECT_GT(longest_way, 2.0);
  EXPECT_LT(longest_roll, 1.0);
}

std::string up_to_the_fault(const std::filesystem::path& table) {
  std::istringstream rows(read_file(table));
  std::string kept;
  for (std::string row; std::getline(rows, row) && !(std::isdigit(row[0]) != 0 && std::stod(row) >= at);)
    kept += row + '\n';
  return kept;
}

TEST(InjectedFaults, ChangeNothingBeforeTheirTime) {
  const TemporaryFolder folder;
  run_live(world_with({}), folder / "without");
  run_live(world_with({kidnapping(), {.kind = FaultKind::bad_observation, .at = at + 1.0, .to = {}}}),
           folder / "with");
  for (const char* table : {"odometry.csv", "observations.csv", "ekf.tum", "seif.tum"}) {
    const std::string kept = up_to_the_fault(folder / "without" / table);
    EXPECT_GT(kept.size(), 1000U) << table;
    EXPECT_EQ(up_to_the_fault(folder / "with" / table), kept) << table;
  }
}

TEST(InjectedFaults, ComeAgainToTheBit) {
  const TemporaryFolder folder;
  const std::vector<Fault> faults = {{.kind = FaultKind::bad_observation, .at = 5.0, .to = {}},
                                     {.kind = FaultKind::outlier, .at = 8.0, .size = 30.0, .to = {}},
                                     {.kind = FaultKind::encoder_jump, .at = 10.0, .jump = 0.5, .to = {}},
                                     kidnapping()};
  const std::string first = run_live(world_with(faults), folder / "a").summary.trajectory_hash;
  EXPECT_EQ(run_live(world_with(faults), folder / "b").summary.trajectory_hash, first);
}

}  // namespace
}  // namespace harness
