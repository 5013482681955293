#include "harness/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "harness/sweep/status.hpp"

namespace harness {
namespace {

using test::read_file;
using test::write_file;

/// Ends its whole process at the first scan, unless this file exists.
class Fragile final : public seif::Estimator {
 public:
  explicit Fragile(std::string held_by) : held_by_(std::move(held_by)) {}
  void motion_update(const seif::Odometry&) override {}
  void measurement_update(const seif::Scan&, const seif::StageDone&) override {
    if (!std::filesystem::exists(held_by_)) std::raise(SIGKILL);
  }
  seif::Pose2 pose() const override { return {}; }
  seif::Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<seif::LandmarkEstimate> map() const override { return {}; }
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId>) const override {
    return std::nullopt;
  }

 private:
  std::string held_by_;
};

seif::Registry fragile_registry() {
  seif::Registry registry = test::test_registry();
  seif::EstimatorType type;
  type.name = "fragile";
  type.help = "Crashes.";
  type.options.push_back({.key = "held_by", .fallback = std::string("/dev/null"), .choices = {}, .help = ""});
  type.make = [](const seif::EstimatorSetup&, const seif::Options& options) {
    return std::make_unique<Fragile>(seif::option<std::string>(options, "held_by"));
  };
  registry.add(std::move(type));
  return registry;
}

class SweepTest : public testing::Test {
 protected:
  SweepTest() {
    write_file(folder / "world.yaml",
               "duration_s: 2\n"
               "physics: {engine: kinematic}\n"
               "landmarks: {generators: [{type: uniform, count: 20}]}\n"
               "estimators: {ekf: {}, fragile: {}}\n");
    choices.world = folder / "world.yaml";
    choices.seeds = "1..3";
  }

  SweepFolder begin(const std::string& out) {
    BegunSweep begun = begin_sweep(choices, folder / out, registry);
    for (const worlds::Problem& problem : begun.problems) ADD_FAILURE() << worlds::to_string(problem);
    return begun.folder.value();
  }

  bool run(const SweepFolder& sweep) { return run_cells(sweep, {}, 2, true, registry); }

  const TemporaryFolder folder;
  const seif::Registry registry = fragile_registry();
  SweepChoices choices;
};

TEST_F(SweepTest, ACellThatCrashesTakesNoOtherDownAndIsTriedAgain) {
  const std::string held_by = (folder / "held").string();
  choices.axes = {"estimators.fragile.held_by=/dev/null," + held_by};
  const SweepFolder sweep = begin("sweep");
  EXPECT_TRUE(run(sweep));
  const SweepStatus status = status_of(sweep);
  EXPECT_EQ(status.done, 3U);
  ASSERT_EQ(status.failed.size(), 3U);
  EXPECT_EQ(status.failed[0].index, 3U);
  EXPECT_EQ(status.failed[0].reason, "ended by signal 9 (Killed)");
  const Aggregate aggregate = write_tables(sweep);
  EXPECT_EQ(aggregate.settings[0].estimators[0].runs, 3U);
  EXPECT_TRUE(aggregate.settings[1].estimators.empty());
  EXPECT_NE(read_file(sweep.path / "runs.csv").find(",3,,ended by signal 9 (Killed),"), std::string::npos);

  const std::string done = read_file(sweep.path / "cells" / "000001.json");
  write_file(held_by, "");
  EXPECT_TRUE(run(sweep));
  EXPECT_EQ(status_of(sweep).done, 6U);
  EXPECT_TRUE(write_tables(sweep).failed.empty());
  EXPECT_EQ(read_file(sweep.path / "cells" / "000001.json"), done) << "times and all: it was not run again";
}

TEST_F(SweepTest, ARunThatEndsBeforeItsTimeFails) {
  write_file(folder / "world.yaml",
             read_file(folder / "world.yaml") + "drive: {pose_from: dead_reckoning}\n");
  choices.overrides = {"estimators.dead_reckoning={fail_after_scans: 2}"};
  const SweepFolder sweep = begin("sweep");
  EXPECT_TRUE(run(sweep));
  const SweepStatus status = status_of(sweep);
  ASSERT_EQ(status.failed.size(), 3U);
  EXPECT_NE(status.failed[2].reason.find("dead_reckoning steers and has failed"), std::string::npos)
      << status.failed[2].reason;
}

TEST_F(SweepTest, AnEstimatorThatFailsCountsAndLeavesTheOthers) {
  choices.overrides = {"estimators={ekf: {}, dead_reckoning: {fail_after_scans: 2}}"};
  const SweepFolder sweep = begin("sweep");
  run(sweep);
  const Aggregate aggregate = write_tables(sweep);
  const std::vector<EstimatorStatistics>& estimators = aggregate.settings[0].estimators;
  EXPECT_EQ(estimators[0].runs, 3U);
  EXPECT_EQ(estimators[1].name, "dead_reckoning");
  EXPECT_EQ(estimators[1].runs, 0U);
  EXPECT_EQ(estimators[1].failed, 3U);
  EXPECT_NE(read_file(sweep.path / "runs.csv").find("gave up"), std::string::npos);
}

TEST_F(SweepTest, BaselineThatIsATypeJoinsAndOneThatASettingLacksIsRefused) {
  choices.baseline = "seif";
  const SweepFolder sweep = begin("sweep");
  EXPECT_EQ(sweep.plan.baseline, "seif");
  run(sweep);
  EXPECT_EQ(write_tables(sweep).settings[0].estimators[2].name, "seif");
  choices.axes = {"estimators={ekf: {}},{seif: {}}"};
  EXPECT_THROW(begin("other"), BadInput);
  EXPECT_FALSE(std::filesystem::exists(folder / "other"));
}

TEST_F(SweepTest, ProblemsOfASettingAreSaidOfItsVaryAndNothingIsWritten) {
  choices.axes = {"duration_s=2,-2"};
  const BegunSweep begun = begin_sweep(choices, folder / "sweep", registry);
  EXPECT_FALSE(begun.folder);
  ASSERT_EQ(begun.problems.size(), 1U);
  EXPECT_TRUE(worlds::to_string(begun.problems[0]).starts_with("--vary duration_s=-2: "))
      << worlds::to_string(begun.problems[0]);
  EXPECT_FALSE(std::filesystem::exists(folder / "sweep"));
}

TEST_F(SweepTest, TheFolderRunsWithoutTheFilesOfTheWorld) {
  write_file(folder / "base.yaml", read_file(folder / "world.yaml"));
  write_file(folder / "told.csv", "t,v,omega\n0,0.5,0.1\n");
  write_file(folder / "world.yaml", "extends: base.yaml\ndrive: {mode: commands, file: told.csv}\n");
  const SweepFolder sweep = begin("sweep");
  for (const char* file : {"base.yaml", "told.csv", "world.yaml"}) std::filesystem::remove(folder / file);
  run(open_sweep(folder / "sweep"));
  const SweepStatus status = status_of(sweep);
  EXPECT_EQ(status.done, 3U) << to_text(sweep, status);
  EXPECT_EQ(sweep.plan.name, "world") << "as the file that is gone was called";
}

TEST_F(SweepTest, AWorldThatHasChangedIsAnotherSweep) {
  begin("sweep");
  begin("sweep");
  write_file(folder / "world.yaml", read_file(folder / "world.yaml") + "ground: {size_m: [30, 30]}\n");
  EXPECT_THROW(begin("sweep"), BadInput);
}

TEST(Shard, IsReadStrictly) {
  EXPECT_EQ(parse_shard("3/16").number, 3U);
  EXPECT_EQ(parse_shard("3/16").of, 16U);
  for (const char* text : {"", "3", "0/4", "5/4", "1/0", "a/4", "1/4x", "1//4", "-1/4"})
    EXPECT_THROW(parse_shard(text), BadInput) << text;
}

}  // namespace
}  // namespace harness
