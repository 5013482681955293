// Logs whose true poses are not known at all times: what is missing is the truth, and no filter is blamed.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/score/details.hpp"
#include "harness/score/scoreboard.hpp"

namespace harness {
namespace {

using test::read_file;
using test::write_file;

class MissingTruth : public testing::Test {
 protected:
  MissingTruth() { test::run_live(world, log); }  // 20 s, scored every 5 s

  /// Deletes the true poses between two times. They are not interpolated then.
  void forget_poses(double from, double to) const {
    std::istringstream rows(read_file(log / "truth.csv"));
    std::string kept;
    for (std::string row; std::getline(rows, row);) {
      const bool is_header = kept.empty();
      if (is_header || std::stod(row) < from || std::stod(row) > to) kept += row + '\n';
    }
    write_file(log / "truth.csv", kept);
    write_file(log / "log.yaml", read_file(log / "log.yaml") + "truth_gap_s: 0.5\n");
  }

  RunResult replay() const { return test::replay(world, log, folder / "replay"); }

  const worlds::World world = test::small_world();
  const TemporaryFolder folder;
  const std::filesystem::path log = folder / "log";
};

TEST_F(MissingTruth, AtAScoringTimeIsToldAndIsNoFaultOfTheFilters) {
  forget_poses(8.0, 12.0);
  const Summary summary = replay().summary;
  EXPECT_EQ(summary.score.times_without_truth, 1);
  EXPECT_EQ(summary.score.without_truth_t, 10.0);
  for (const EstimatorScore& score : summary.score.estimators) {
    EXPECT_EQ(score.improper_beliefs, 0) << score.name;
    EXPECT_TRUE(score.nees_pose && score.landmarks.rmse) << score.name;
  }
  const std::string board = scoreboard(summary);
  EXPECT_NE(board.find("The true pose is not known at 1 scoring times, the first at 10 s"), std::string::npos)
      << board;
  EXPECT_EQ(board.find("positive definite"), std::string::npos) << board;
}

TEST_F(MissingTruth, AtTheStartLeavesTheErrorsAfterAlignment) {
  forget_poses(0.0, 6.0);
  const Summary summary = replay().summary;
  EXPECT_FALSE(summary.score.frame_is_known);
  const RunDetails details =
      score_details(folder / "replay", std::vector<std::string>{"ekf", "seif_report"}, {});
  for (std::size_t i = 0; i < 2; ++i) {
    const EstimatorScore& score = summary.score.estimators[i];
    EXPECT_FALSE(score.landmarks.rmse || score.trajectory.rmse) << score.name;
    EXPECT_TRUE(score.landmarks.rmse_aligned && score.trajectory.rmse_aligned) << score.name;
    EXPECT_FALSE(score.nees_pose || score.nees_landmark || score.diverged_nees_t) << score.name;
    EXPECT_EQ(score.improper_beliefs, 0) << score.name;
    EXPECT_FALSE(details.estimators[i].landmarks_inside || details.estimators[i].pose_inside);
    EXPECT_TRUE(details.estimators[i].landmark_rmse_from_robot) << "the frame of the robot is known";
  }
  EXPECT_NE(scoreboard(summary).find("The true pose at the start is not known"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(read_file(folder / "replay" / "summary.json"))["true_frame_known"], false);
}

// What other programs write often begins with the first scan or increment, not with the start.
TEST_F(MissingTruth, BeforeTheFirstEventDoesNoHarm) {
  forget_poses(0.0, 1e-9);
  const Summary summary = replay().summary;
  EXPECT_TRUE(summary.score.frame_is_known);
  EXPECT_TRUE(summary.score.estimators[0].landmarks.rmse);
  EXPECT_TRUE(summary.score.estimators[0].nees_pose);
}

TEST_F(MissingTruth, OfAllPosesLeavesTheAlignedErrorOfTheMap) {
  std::filesystem::remove(log / "truth.csv");
  const Summary summary = replay().summary;
  for (const EstimatorScore& score : summary.score.estimators) {
    EXPECT_FALSE(score.landmarks.rmse) << score.name;
    EXPECT_TRUE(score.landmarks.rmse_aligned) << score.name;
    EXPECT_FALSE(score.nees_landmark) << score.name;
    EXPECT_EQ(score.improper_beliefs, 0) << score.name;
  }
}

}  // namespace
}  // namespace harness
