// Results of other programs, scored from their files.
#include "harness/score/foreign.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/command_call.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;
using test::write_file;

constexpr double hand_rounding = 1e-12;

TEST(Foreign, AMapIsScoredAsComputedByHand) {
  const TemporaryFolder folder;
  write_file(folder / "landmarks.csv", "landmark,x,y\n0,0,0\n1,2,0\n2,9,9\n");
  write_file(folder / "mine.csv",
             "landmark,x,y,cov_xx,cov_xy,cov_yy\n0,0.1,0,0.01,0,0.01\n1,2.2,0,0.01,0,0.02\n7,1,1,,,\n");
  const EstimatorScore score =
      score_foreign({.map = folder / "mine.csv", .landmarks = folder / "landmarks.csv"}, 1.0).score;
  EXPECT_EQ(score.name, "mine");
  EXPECT_EQ(score.landmarks_mapped, 3);
  EXPECT_EQ(score.landmarks_spurious, 1);
  EXPECT_NEAR(*score.landmarks.rmse, std::sqrt((0.01 + 0.04) / 2), hand_rounding);
  EXPECT_NEAR(*score.landmarks.rmse_aligned, 0.05, hand_rounding);
  EXPECT_NEAR(*score.nees_landmark, (0.5 + 2.0) / 2, hand_rounding);
  EXPECT_FALSE(score.trajectory.rmse || score.nees_pose);
}

TEST(Foreign, ATrajectoryWithCovariancesIsScoredAsComputedByHand) {
  const TemporaryFolder folder;
  write_file(folder / "truth.csv", "t,x,y,theta\n0,0,0,0\n1,1,0,0\n2,2,0,0\n");
  write_file(folder / "mine.csv",
             "t,x,y,theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt\n"
             "0,0,0.3,0,0.01,0,0,0.01,0,0.01\n0.5,0.5,0.3,0,,,,,,\n3,3,0.3,0,0.01,0,0,0.01,0,0.01\n");
  const ForeignScore scored =
      score_foreign({.trajectory = folder / "mine.csv", .truth = folder / "truth.csv"}, 0.5);
  EXPECT_EQ(scored.poses, 2);
  EXPECT_EQ(scored.poses_without_truth, 1);
  EXPECT_NEAR(*scored.score.trajectory.rmse, 0.3, hand_rounding);
  EXPECT_NEAR(*scored.score.rpe.translation, 0.0, hand_rounding);
  EXPECT_NEAR(*scored.score.nees_pose, 0.09 / 0.01 / 3, hand_rounding);
}

std::string error_of(const ForeignFiles& files) {
  try {
    score_foreign(files, 1.0);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(Foreign, WrongFilesAreRefusedAtTheirPlace) {
  const TemporaryFolder folder;
  write_file(folder / "truth.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  write_file(folder / "back.csv", "t,x,y,theta\n1,0,0,0\n0,0,0,0\n");
  write_file(folder / "nan.csv", "t,x,y,theta\n1,0,nan,0\n");
  write_file(folder / "late.tum", "5 0 0 0 0 0 0 1\n");
  write_file(folder / "map.csv", "landmark,x,y\n3,0,0\n");
  write_file(folder / "landmarks.csv", "landmark,x,y\n0,0,0\n");
  const auto trajectory = [&](const char* name) {
    return error_of({.trajectory = folder / name, .truth = folder / "truth.tum"});
  };
  EXPECT_NE(trajectory("back.csv").find("back.csv:3:1: t: 0 s is before 1 s"), std::string::npos)
      << trajectory("back.csv");
  EXPECT_NE(trajectory("nan.csv").find("nan.csv:2:5"), std::string::npos) << trajectory("nan.csv");
  EXPECT_NE(trajectory("late.tum").find("no true pose"), std::string::npos) << trajectory("late.tum");
  EXPECT_NE(trajectory("nowhere.tum"), "");
  EXPECT_NE(error_of({.map = folder / "map.csv", .landmarks = folder / "landmarks.csv"})
                .find("none of its landmarks"),
            std::string::npos);
}

// The files of a run are files like any other program's.
TEST(ForeignCommand, GivesTheScoresOfARun) {
  const TemporaryFolder folder;
  const Called ran =
      call(folder, "run courtyard --duration 20 --set 'estimators={ekf: {}}' --out run --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.errors;
  const nlohmann::json run = nlohmann::json::parse(ran.output)["estimators"]["ekf"];
  const Called called =
      call(folder, "score --trajectory run/ekf.tum --map run/ekf_map.csv --truth run --json");
  ASSERT_EQ(called.exit_code, 0) << called.errors;
  const nlohmann::json scored = nlohmann::json::parse(called.output);
  for (const char* key :
       {"ate_rmse_m", "ate_rmse_aligned_m", "rpe_trans_m", "rpe_rot_rad", "landmarks_mapped",
        "landmarks_spurious", "landmark_rmse_m", "landmark_rmse_aligned_m"})
    EXPECT_EQ(scored[key], run[key]) << key;
  EXPECT_NE(call(folder, "score --trajectory run/ekf.tum --truth run").output.find("ATE [m]"),
            std::string::npos);
}

TEST(ForeignCommand, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  for (const char* arguments :
       {"score", "score --trajectory a.tum", "score --map a.csv", "score --map a.csv --truth b.tum",
        "score run --trajectory a.tum", "score --rpe-s 2"}) {
    const Called called = call(folder, arguments);
    EXPECT_EQ(called.exit_code, 2) << arguments;
    EXPECT_NE(called.errors.find("--"), std::string::npos) << arguments << ": " << called.errors;
  }
}

}  // namespace
}  // namespace harness
