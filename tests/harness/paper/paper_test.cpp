#include "harness/paper/paper.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "harness/estimators/registry.hpp"
#include "harness/fixtures.hpp"
#include "harness/paper/drawn_run.hpp"
#include "harness/paper/report_world.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/prepared_run.hpp"

namespace harness {
namespace {

using test::read_file;

/// `seif` leaves the uncertainty of its start, three degrees of freedom, out of its information matrix.
void expect_inverse_up_to_the_start(const Belief& belief) {
  const Eigen::MatrixXd inverse = belief.information.inverse();
  const Eigen::MatrixXd added = belief.covariance - inverse;
  const Eigen::VectorXd modes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(added).eigenvalues();
  const double rounding = 1e-6 * inverse.norm();
  EXPECT_GT(modes(0), -rounding) << belief.estimator;
  const bool in_start_frame = belief.estimator == "seif";
  EXPECT_LT(modes(modes.size() - (in_start_frame ? 4 : 1)), rounding) << belief.estimator;
  EXPECT_EQ(modes(modes.size() - 1) > rounding, in_start_frame) << belief.estimator;
}

class Paper : public testing::Test {
 protected:
  void set_up(std::vector<std::string> overrides, std::int64_t runs) {
    plan_.overrides = std::move(overrides);
    plan_.runs = runs;
    plan_.folder = folder_.path();
    plan_.quiet = true;
    const worlds::LoadResult loaded = load_paper_world(plan_, registry_);
    ASSERT_TRUE(loaded.world) << worlds::to_string(loaded.problems.front());
    world_ = *loaded.world;
    write_world(folder_.path(), world_, loaded.resolved);
  }

  std::int64_t option(std::size_t estimator, const std::string& key) const {
    return std::get<std::int64_t>(world_.estimators.at(estimator).options.at(key));
  }

  const TemporaryFolder folder_;
  const seif::Registry registry_ = known_estimators();
  PaperPlan plan_;
  worlds::World world_;
};

TEST_F(Paper, HasTheWorldFileInTheProgram) {
  EXPECT_EQ(report_world(), read_file(SEIFBED_SOURCE_DIR "/worlds/report2002.yaml"));
}

TEST_F(Paper, IsSetUpAsTheReportSays) {
  set_up({}, 1'000);
  EXPECT_EQ(world_.landmarks.size(), 50U);
  EXPECT_EQ(world_.duration * world_.landmark_sensor.rate, 500.0);
  EXPECT_EQ(world_.physics.engine, worlds::Engine::kinematic);
  ASSERT_EQ(world_.estimators.size(), paper_rows.size());
  for (std::size_t i = 0; i < paper_rows.size(); ++i)
    EXPECT_EQ(world_.estimators[i].name, paper_rows[i].estimator);
  EXPECT_EQ(option(1, "theta_x"), 6);
  EXPECT_EQ(option(2, "theta_x"), 6);
  EXPECT_EQ(option(2, "K"), 10);
}

TEST_F(Paper, RunsInBulletIfItIsTold) {
  plan_.physics = true;
  set_up({}, 1);
  EXPECT_EQ(world_.physics.engine, worlds::Engine::bullet);
}

TEST_F(Paper, TheEkfSeesAndLinksAllLandmarksAsTheReportsDoes) {
  set_up({"estimators={ekf: {}}"}, 4);
  plan_.first_seed = 20;
  const Comparison comparison = run_paper(plan_, "paper", registry_);
  ASSERT_EQ(comparison.runs.size(), 4U);
  EXPECT_EQ(comparison.runs.front().name, "paper-20");
  std::set<std::string> hashes;
  for (const ComparedRun& run : comparison.runs) {
    const Summary& summary = run.result.summary;
    EXPECT_EQ(summary.updates, 500);
    EXPECT_EQ(summary.score.estimators.front().links, 1'275) << run.name;
    hashes.insert(summary.trajectory_hash);
  }
  EXPECT_EQ(hashes.size(), 4U) << "each seed has a world of its own";
}

TEST_F(Paper, WhatIsDrawnIsTheFirstRunOfTheTable) {
  set_up({"duration_s=6"}, 1);
  const Comparison comparison = run_paper(plan_, "paper", registry_);
  const std::vector<Belief> beliefs = drawn_beliefs(plan_, registry_);
  ASSERT_EQ(beliefs.size(), 3U);
  const std::vector<std::size_t> rows = {0, 2, 3};  // ekf, seif_report, seif
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const Belief& belief = beliefs[i];
    const EstimatorComparison& row = comparison.estimators.at(rows[i]);
    EXPECT_EQ(belief.estimator, row.name);
    const auto links = static_cast<double>(links_of(normalised(belief.information)).size());
    EXPECT_EQ(links, row.links->value) << row.name;
    double squares = 0.0;
    for (const PointPair& landmark : belief.landmarks)
      squares += (landmark.est_point - landmark.true_point).squaredNorm();
    EXPECT_NEAR(squares / static_cast<double>(belief.landmarks.size()), row.landmark_mse->value,
                1e-6 * row.landmark_mse->value)
        << row.name;
    expect_inverse_up_to_the_start(belief);
    // The pose, through the NEES that was computed from the run's own files.
    const Eigen::Vector3d error = pose_error(belief.pose.est_pose, belief.pose.true_pose);
    EXPECT_NEAR(nees(error, Eigen::Matrix3d(belief.covariance.topLeftCorner<3, 3>())).value(),
                row.nees_pose->value, 1e-6 * row.nees_pose->value)
        << row.name;
  }
}

TEST_F(Paper, DrawsEachFigureAsPngAndAsSvgThatNeedsNoOtherFile) {
  set_up({"duration_s=4"}, 1);
  ASSERT_EQ(draw_figures(plan_, registry_), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1 + 6);
  const std::vector<std::pair<std::string, int>> images = {{"figure1", 2}, {"figure2", 1}, {"figure6", 6}};
  for (const auto& [name, matrices] : images) {
    EXPECT_TRUE(read_file(folder_ / (name + ".png")).starts_with("\x89PNG")) << name;
    const std::string svg = read_file(folder_ / (name + ".svg"));
    EXPECT_NE(svg.find("SEIF, constant time: links") != std::string::npos, name == "figure1") << name;
    int found = 0;
    for (std::size_t at = 0; (at = svg.find("data:image/png;base64", at)) != std::string::npos; ++at) ++found;
    EXPECT_EQ(found, matrices) << name;
  }
}

TEST_F(Paper, SaysWhyThereAreNoFigures) {
  set_up({"duration_s=2", "sensors.landmark_sensor.false_detections_per_scan=5"}, 1);
  const std::string complaint = draw_figures(plan_, registry_);
  EXPECT_NE(complaint.find("no figures: the belief of ekf cannot be drawn: its map has a landmark"),
            std::string::npos)
      << complaint;
}

}  // namespace
}  // namespace harness
