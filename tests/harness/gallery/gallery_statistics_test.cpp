// What the worlds of the gallery are meant to show, over enough seeds for a significant result.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/fixtures.hpp"
#include "worlds/load.hpp"

namespace harness {
namespace {

worlds::World gallery_world(const std::string& name, std::vector<std::string> overrides) {
  const worlds::LoadResult loaded = worlds::load_world(SEIFBED_SOURCE_DIR "/worlds/" + name + ".yaml",
                                                       overrides, estimator_schemas(test::test_registry()));
  EXPECT_TRUE(loaded.problems.empty());
  return loaded.world.value();
}

struct MeanScores {
  double pose = 0.0;
  double landmark = 0.0;
  double squared_error = 0.0;  // mean over the landmarks [m^2]
};

/// Means over `seeds` runs of the estimator's NEES per degree of freedom, and of its error, at the end of each
/// run.
std::vector<MeanScores> final_scores(const std::string& world_name, const std::vector<std::string>& overrides,
                                     int seeds) {
  std::vector<MeanScores> means;
  for (int seed = 1; seed <= seeds; ++seed) {
    const TemporaryFolder folder;
    worlds::World world = gallery_world(world_name, overrides);
    world.seed = static_cast<std::uint64_t>(seed);
    const RunResult result = test::run_live(world, folder / "run");
    EXPECT_EQ(exit_code(result), 0) << result.error;
    means.resize(result.summary.score.estimators.size());
    for (std::size_t i = 0; i < means.size(); ++i) {
      means[i].pose += result.summary.score.estimators[i].nees_pose_final.value() / seeds;
      means[i].landmark += result.summary.score.estimators[i].nees_landmark_final.value_or(0.0) / seeds;
      means[i].squared_error +=
          std::pow(result.summary.score.estimators[i].landmarks.rmse.value_or(0.0), 2) / seeds;
    }
  }
  return means;
}

TEST(Gallery, CourtyardHoldsTheEkfAndSeifInTheirBandAndTheReportsSeifFarOutside) {
  const std::vector<MeanScores> nees = final_scores("courtyard", {"sensors.encoders.calibrated=true"}, 20);
  ASSERT_EQ(nees.size(), 3U);  // ekf, seif, seif_report
  // Bands of the chi-square distribution over 20 runs. For the pose: 60 degrees of freedom. The landmarks of
  // one run share their errors, so they count as one landmark: 40.
  for (const int i : {0, 1}) {
    const MeanScores& consistent = nees[static_cast<std::size_t>(i)];
    EXPECT_GT(consistent.pose, 40.48 / 60) << i;
    EXPECT_LT(consistent.pose, 83.30 / 60) << i;
    EXPECT_GT(consistent.landmark, 24.43 / 40) << i;
    EXPECT_LT(consistent.landmark, 59.34 / 40) << i;
  }
  const MeanScores& seif_report = nees[2];
  EXPECT_GT(seif_report.pose, 30.0);
  EXPECT_GT(seif_report.landmark, 30.0);
}

// 60 degrees of freedom for the pose, 40 for the landmarks, as above.
TEST(Gallery, Report2002HoldsAllButTheReportsSeifInTheirBandsInTheKinematicEngine) {
  const std::vector<std::string> names{"ekf", "eif", "eseif", "seif", "seif_report"};
  const std::vector<MeanScores> scores = final_scores(
      "report2002",
      {"physics.engine=kinematic", "estimators={ekf: {}, eif: {}, eseif: {}, seif: {}, seif_report: {}}"},
      20);
  ASSERT_EQ(scores.size(), names.size());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(scores[i].pose, 40.48 / 60) << names[i];
    EXPECT_LT(scores[i].pose, 83.30 / 60) << names[i];
    EXPECT_GT(scores[i].landmark, 24.43 / 40) << names[i];
    EXPECT_LT(scores[i].landmark, 59.34 / 40) << names[i];
  }
  EXPECT_GT(scores[4].pose, 10.0);
  EXPECT_GT(scores[4].landmark, 10.0);
}

// The difference between seif and the EKF is smaller than the spread of 20 runs, so this takes more runs.
TEST(Gallery, Report2002GivesSeifTheErrorOfTheEkf) {
  const std::vector<MeanScores> scores =
      final_scores("report2002", {"physics.engine=kinematic", "estimators={ekf: {}, seif: {}}"}, 100);
  const double seif_over_ekf = scores.at(1).squared_error / scores.at(0).squared_error;
  EXPECT_GT(seif_over_ekf, 0.9);
  EXPECT_LT(seif_over_ekf, 1.1);
}

// With a sensor that sees nothing, only dead reckoning and its covariance are left.
const std::vector<std::string> blind{"sensors.landmark_sensor.max_range_m=0.05", "estimators={ekf: {}}",
                                     "sensors.encoders.calibrated=true"};

TEST(Gallery, SlipperyHasOdometryErrorsThatTheNoiseDoesNotExplain) {
  std::vector<std::string> without_patches = blind;
  without_patches.push_back("physics.patches=[]");
  const double with_slip = final_scores("slippery", blind, 10).at(0).pose;
  const double without_slip = final_scores("slippery", without_patches, 10).at(0).pose;
  EXPECT_GT(without_slip, 16.79 / 30);  // chi-square, 30 degrees of freedom, 95 %
  EXPECT_LT(without_slip, 46.98 / 30);
  EXPECT_GT(with_slip, 10.0);
}

TEST(Gallery, UmbmarkHasSystematicErrorsThatCalibrationTakesAway) {
  std::vector<std::string> as_it_is = blind;
  as_it_is.back() = "sensors.encoders.calibrated=false";
  EXPECT_GT(final_scores("umbmark", as_it_is, 10).at(0).pose, 10.0);
  const double calibrated = final_scores("umbmark", blind, 10).at(0).pose;
  EXPECT_GT(calibrated, 16.79 / 30);
  EXPECT_LT(calibrated, 46.98 / 30);
}

class GalleryWorld : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, GalleryWorld,
                         testing::Values("courtyard", "report2002", "loop", "orchard", "forest", "walls",
                                         "slippery", "umbmark"),
                         [](const auto& world) { return std::string(world.param); });

// Ice and wrong wheels make innovations too large, which is no divergence. Kidnapping is one.
TEST_P(GalleryWorld, HasNoFilterOfOursThatSaysItDiverged) {
  const TemporaryFolder folder;
  worlds::World world = gallery_world(GetParam(), {"duration_s=400"});
  std::erase_if(world.estimators, [](const worlds::EstimatorChoice& c) { return c.type == "seif_report"; });
  const RunResult result = test::run_live(world, folder / "run");
  ASSERT_FALSE(result.summary.score.estimators.empty());
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_FALSE(score.diverged_t) << score.name << ", NIS up to " << score.worst_nis.value_or(0.0);
    EXPECT_TRUE(score.worst_nis) << score.name;
  }
}

TEST(Gallery, FaultsAreToldWhereTheRobotIsCarriedOffAndNotBefore) {
  const TemporaryFolder folder;
  worlds::World world = gallery_world("faults", {});
  for (worlds::EstimatorChoice& estimator : world.estimators) estimator.options["relocate"] = "never";
  const RunResult result = test::run_live(world, folder / "run");
  EXPECT_EQ(result.summary.left_out.size(), 2U);
  for (const EstimatorScore& score : result.summary.score.estimators) {
    ASSERT_TRUE(score.diverged_t) << score.name;
    EXPECT_GT(*score.diverged_t, 100.0) << score.name;
    EXPECT_LT(*score.diverged_t, 105.0) << score.name;
    EXPECT_GE(score.diverged_nees_t, 100.0) << score.name;
  }
}

TEST(Gallery, FaultsEndWithARobotThatHasFoundItsPlaceAgain) {
  const TemporaryFolder folder;
  const RunResult result = test::run_live(gallery_world("faults", {}), folder / "run");
  for (const EstimatorScore& score : result.summary.score.estimators) {
    EXPECT_FALSE(score.diverged_t) << score.name;
    EXPECT_FALSE(score.diverged_nees_t) << score.name;
    EXPECT_EQ(score.losses.found(), 1) << score.name;
    EXPECT_EQ(score.losses.found_wrongly(), 0) << score.name;
  }
}

TEST_P(GalleryWorld, RunsAndSeesLandmarks) {
  const TemporaryFolder folder;
  const RunResult result = test::run_live(gallery_world(GetParam(), {"duration_s=10"}), folder / "run");
  EXPECT_EQ(exit_code(result), 0) << result.error;
  ASSERT_FALSE(result.summary.score.estimators.empty());
  EXPECT_GE(result.summary.score.estimators.back().landmarks_mapped.value(), 2);
}

}  // namespace
}  // namespace harness
