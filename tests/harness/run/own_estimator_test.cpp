// An example of your own estimator, from the class to the world file that names it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/fixtures.hpp"
#include "harness/recording/run_folder.hpp"
#include "seif/estimator.hpp"
#include "seif/models.hpp"
#include "seif/registry.hpp"

namespace {

/// Odometry alone: it chains the increments, and their noise enlarges the covariance of the pose. It has no
/// map.
class OdometryAlone final : public seif::Estimator {
 public:
  /// `noise_factor`: standard deviations that the filter assumes, divided by those that the encoders report.
  OdometryAlone(const seif::EstimatorSetup& setup, double noise_factor)
      : belief_(setup.start), noise_factor_(noise_factor) {}

  void motion_update(const seif::Odometry& odometry) override {
    const seif::PredictedPose predicted = seif::predict_pose(belief_.mean, odometry);
    const Eigen::Matrix3d& F = predicted.J_wrt_pose;
    const Eigen::Matrix3d L = noise_factor_ * predicted.noise_factor;
    belief_.mean = predicted.pose;
    belief_.covariance = F * belief_.covariance * F.transpose() + L * L.transpose();
    ++blocks_touched_;
  }

  /// A filter with a map would process the observations here, and report each of its stages.
  void measurement_update(const seif::Scan&, const seif::StageDone& done) override {
    done(seif::Stage::measurement);
  }

  seif::Pose2 pose() const override { return belief_.mean; }
  std::optional<Eigen::Matrix3d> pose_covariance() const override { return belief_.covariance; }
  seif::Counts counts() const override { return {.blocks_touched = blocks_touched_}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<seif::LandmarkEstimate> map() const override { return {}; }
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId>) const override {  // always empty: there is no map
    return seif::MarginalCovariances{.pose = belief_.covariance, .landmarks = {}};
  }

 private:
  seif::PoseEstimate belief_;
  double noise_factor_;
  std::int64_t blocks_touched_ = 0;
};

seif::EstimatorType odometry_alone() {
  const seif::OptionSpec noise_factor{
      .key = "noise_factor",
      .fallback = 1.0,
      .min = 0.0,
      .max = 100.0,
      .help =
          "Standard deviations of the odometry that are believed, over those that the encoders tell [-]."};
  return {.name = "odometry_alone",
          .help = "Odometry alone, with its covariance.",
          .options = {noise_factor},
          .make = [](const seif::EstimatorSetup& setup, const seif::Options& options) {
            return std::make_unique<OdometryAlone>(setup, seif::option<double>(options, "noise_factor"));
          }};
}

/// The registry as harness/commands/main.cpp would make it.
seif::Registry own_registry() {
  seif::Registry registry = seif::standard_estimators();
  registry.add(odometry_alone());
  return registry;
}

}  // namespace

namespace harness {
namespace {

/// A square of 4 m with landmarks around it, in a world file that names the estimator twice.
const char* const world_file =
    "name: mine\n"
    "duration_s: 20\n"
    "landmarks: {placed: [{x_m: 3, y_m: 3}, {x_m: -3, y_m: 3}]}\n"
    "drive: {mode: loop, waypoints_m: [[2, 2], [-2, 2], [-2, -2], [2, -2]]}\n"
    "sensors: {encoders: {calibrated: true}}\n"
    "estimators:\n"
    "  odometry_alone: {}\n"
    "  daring: {type: odometry_alone, noise_factor: 0.1}\n";

worlds::LoadResult load(const TemporaryFolder& folder, const std::string& text) {
  test::write_file(folder / "mine.yaml", text);
  return worlds::load_world(folder / "mine.yaml", {}, estimator_schemas(own_registry()));
}

TEST(OwnEstimator, IsUsedByAWorldFileUnderItsNameAndScored) {
  const TemporaryFolder folder;
  const worlds::LoadResult loaded = load(folder, world_file);
  ASSERT_TRUE(loaded.world) << (loaded.problems.empty() ? "" : loaded.problems[0].message);
  const RunResult result = test::run_live(*loaded.world, folder / "run", own_registry());
  EXPECT_EQ(exit_code(result), 0) << result.error;
  ASSERT_EQ(result.summary.score.estimators.size(), 2U);
  const EstimatorScore& own = result.summary.score.estimators[0];
  EXPECT_EQ(own.landmarks_mapped, 0);
  EXPECT_GT(own.trajectory.rmse.value(), 0.0);
  EXPECT_EQ(test::read_file(folder / "run" / "odometry_alone.tum"),
            test::read_file(folder / "run" / "odometry.tum"));  // the harness's own dead reckoning
  // The option had an effect: a belief that is ten times more certain has a larger NEES.
  EXPECT_GT(result.summary.score.estimators[1].nees_pose_final.value(), own.nees_pose_final.value());
}

TEST(OwnEstimator, HasItsOptionsChecked) {
  const TemporaryFolder folder;
  const std::string good = world_file;
  const std::size_t option = good.find("0.1");
  const std::string text = good.substr(0, option) + "-1" + good.substr(option + 3);
  const worlds::LoadResult loaded = load(folder, text);
  EXPECT_FALSE(loaded.world);
  ASSERT_EQ(loaded.problems.size(), 1U);
}

TEST(OwnEstimator, IsAsSureAsItMayBeWithCalibratedEncoders) {
  constexpr int runs = 20;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const TemporaryFolder folder;
    worlds::World world = load(folder, world_file).world.value();
    world.seed = seed;
    world.landmark_sensor.max_range = 0.5;  // the sensor sees nothing
    sum += test::run_live(world, folder / "run", own_registry())
               .summary.score.estimators[0]
               .nees_pose_final.value();
  }
  // chi-square of 3 x 20 degrees of freedom, 95 %
  EXPECT_GT(sum / runs, 40.48 / 60);
  EXPECT_LT(sum / runs, 83.30 / 60);
}

}  // namespace
}  // namespace harness
