// MRPT's EKF-SLAM against ours: two programs that share only the equations.
#include "harness/estimators/mrpt_ekf.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "harness/score/score_folder.hpp"

namespace harness {
namespace {

class MrptEkfTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(peers_module()))
      GTEST_SKIP() << "built without MRPT; SEIFBED_PEERS=1 ./test installs it and builds with it";
  }

  static worlds::World world_of(const worlds::EstimatorChoice& peer) {
    worlds::World world = test::small_world();
    world.estimators = {test::choice("ekf"), peer};
    return world;
  }

  const TemporaryFolder folder;
};

// The remaining difference is that MRPT stores measurements in single precision.
TEST_F(MrptEkfTest, IsOurEkf) {
  const Summary summary = test::run_live(world_of(test::choice("mrpt_ekf")), folder / "run").summary;
  EXPECT_EQ(summary.failures, (std::vector<std::string>{"", ""}));
  const std::vector<MapRecord> ours = read_map(folder / "run", "ekf");
  const std::vector<MapRecord> theirs = read_map(folder / "run", "mrpt_ekf");
  ASSERT_EQ(theirs.size(), ours.size());
  ASSERT_GT(theirs.size(), 5U);
  for (const MapRecord& landmark : theirs) {
    const auto other = std::ranges::find(ours, landmark.landmark, &MapRecord::landmark);
    ASSERT_NE(other, ours.end());
    EXPECT_LT((landmark.mean - other->mean).norm(), 1e-5) << landmark.landmark;
    EXPECT_TRUE(landmark.covariance->isApprox(*other->covariance, 1e-4)) << landmark.landmark;
  }
  const EstimatorScore& ekf = summary.score.estimators[0];
  const EstimatorScore& peer = summary.score.estimators[1];
  EXPECT_NEAR(*peer.trajectory.rmse, *ekf.trajectory.rmse, 1e-5);
  EXPECT_NEAR(*peer.nees_pose, *ekf.nees_pose, 1e-3 * *ekf.nees_pose);
  EXPECT_EQ(peer.links, ekf.links);
  EXPECT_GT(peer.update_us->p50, 0.0);
}

TEST_F(MrptEkfTest, TellsItsCovariancesBetweenAMotionAndItsScan) {
  const seif::Registry registry = test::test_registry();
  const seif::EstimatorSetup setup{
      {{1.0, 2.0, 0.3}, Eigen::Vector3d(0.01, 0.02, 0.03).asDiagonal()}, {0.2, 0.1, -0.4}, {}};
  const auto peer = registry.find("mrpt_ekf")->make(setup, test::choice("mrpt_ekf").options);
  const auto ekf = registry.find("ekf")->make(setup, test::choice("ekf").options);
  const Eigen::Matrix2d noise = Eigen::Vector2d(0.01, 0.0004).asDiagonal();
  const Eigen::Matrix3d R = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  for (seif::Estimator* filter : {peer.get(), ekf.get()}) {
    const auto move = [&](double t) { filter->motion_update({t, {0.5, 0.0, 0.2}, R}); };
    const auto see = [&](double t, std::vector<seif::Observation> seen) {
      filter->measurement_update({t, std::move(seen)}, [](seif::Stage) {});
    };
    move(0.1);
    see(0.1, {});
    move(0.2);
    see(0.2, {{7, 2.0, 0.5, noise}, {3, 3.0, -0.5, noise}});
    move(0.3);
    see(0.3, {{3, 2.6, -0.7, noise}});
    move(0.4);
  }
  const std::vector<seif::LandmarkIds> groups = {{3, 7}, {7}, {}};
  const auto theirs = peer->joint_covariances(groups);
  const auto ours = ekf->joint_covariances(groups);
  for (std::size_t i = 0; i < groups.size(); ++i) EXPECT_TRUE((*theirs)[i].isApprox((*ours)[i], 1e-5)) << i;
  EXPECT_TRUE(peer->pose_covariance()->isApprox(*ekf->pose_covariance(), 1e-5));
  EXPECT_NEAR(peer->pose().x, ekf->pose().x, 1e-6);
  EXPECT_NEAR(peer->pose().theta, ekf->pose().theta, 1e-6);
}

TEST_F(MrptEkfTest, OneScalarAtOnceIsNearlyTheSame) {
  worlds::EstimatorChoice davison = test::choice("mrpt_ekf");
  davison.options["method"] = std::string("davison");
  const Summary summary = test::run_live(world_of(davison), folder / "run").summary;
  EXPECT_NEAR(*summary.score.estimators[1].landmarks.rmse, *summary.score.estimators[0].landmarks.rmse, 0.01);
  EXPECT_NE(*summary.score.estimators[1].landmarks.rmse, *summary.score.estimators[0].landmarks.rmse);
}

TEST(MrptEkf, SaysWhatIsMissingWhereItIs) {
  const seif::EstimatorType type = mrpt_ekf_estimator("/nowhere/libpeers.so");
  try {
    type.make({}, {{"method", std::string("naive")}});
    FAIL() << "it was made";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("libmrpt-slam-dev"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace harness
