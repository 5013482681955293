// A robot that is put back into its map, against dense matrices from which the old pose was marginalised.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "seif/dense/ekf.hpp"
#include "seif/path_drive.hpp"
#include "seif/relocating/surroundings.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

const StageDone nobody = [](Stage) {};
const Pose2 elsewhere{3.0, 1.0, 2.0};
constexpr LandmarkId new_one = 100;

test::Points two_rows() {
  test::Points landmarks;
  for (int i = 0; i < 10; ++i) {
    landmarks.emplace_back(1.5 * i, 1.5 + 0.1 * (i % 3));
    landmarks.emplace_back(1.5 * i + 0.4, -1.7 - 0.1 * (i % 4));
  }
  return landmarks;
}

template <class Filter>
void drive(Filter& filter, test::PathDrive& way) {
  while (!way.at_end()) {
    way.advance();
    filter.motion_update(way.odometry());
    filter.measurement_update(way.scan(), nobody);
  }
}

/// What the robot sees from `elsewhere` of the landmarks 2 to 5 as they are believed to be, but for some centimetres, and
/// of one that is new; with errors that belong together.
Relocation seen_from_there(const Estimator& filter, bool keeps_pose) {
  std::vector<LandmarkEstimate> known;
  filter.landmarks(std::vector<LandmarkId>{2, 3, 4, 5}, known);
  std::mt19937_64 random(3);
  std::normal_distribution<double> error(0.0, 0.03);
  Relocation relocation{.T_world_robot = elsewhere, .surroundings = {}, .keeps_pose = keeps_pose};
  Surroundings& around = relocation.surroundings;
  std::vector<double> p;
  const auto see = [&](LandmarkId id, const Eigen::Vector2d& p_robot) {
    around.landmarks.push_back(id);
    p.push_back(p_robot.x() + error(random));
    p.push_back(p_robot.y() + error(random));
  };
  for (const LandmarkEstimate& landmark : known) see(landmark.landmark, inverse(elsewhere) * landmark.mean);
  see(new_one, {1.0, -2.0});
  around.p_robot = Eigen::Map<Eigen::VectorXd>(p.data(), static_cast<Eigen::Index>(p.size()));
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(around.p_robot.size(), around.p_robot.size(),
                                                            [&] { return error(random); });
  around.covariance = root * root.transpose();
  around.covariance.diagonal().array() += 1e-4;
  return relocation;
}

/// The same by dense matrices: the information of [pose | landmarks] without the pose, and with one landmark more.
struct Dense {
  Eigen::MatrixXd Omega;
  Eigen::VectorXd mu;
};

Dense relocated(const Eigen::MatrixXd& Omega, const Eigen::VectorXd& mu, const std::vector<int>& rows,
                const Relocation& relocation) {
  const Eigen::Index n = Omega.rows();
  Dense dense{Eigen::MatrixXd::Zero(n + 2, n + 2), Eigen::VectorXd(n + 2)};
  dense.Omega.topLeftCorner(n, n) = Omega;
  dense.mu << mu, relocation.T_world_robot * relocation.surroundings.at(relocation.surroundings.size() - 1);
  if (!relocation.keeps_pose) {
    const Eigen::MatrixXd map = Omega.bottomRightCorner(n - 3, n - 3) -
                                Omega.bottomLeftCorner(n - 3, 3) * Omega.topLeftCorner<3, 3>().inverse() *
                                    Omega.topRightCorner(3, n - 3);
    dense.Omega.setZero();
    dense.Omega.block(3, 3, n - 3, n - 3) = map;
    dense.mu.head<3>() << elsewhere.x, elsewhere.y, elsewhere.theta;
  }
  const Pose2 at{dense.mu(0), dense.mu(1), dense.mu(2)};
  const auto k = static_cast<Eigen::Index>(relocation.surroundings.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * k, n + 2);
  Eigen::VectorXd v(2 * k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const Eigen::Index row = i + 1 < k ? rows[static_cast<std::size_t>(i)] : n;
    const ExpectedPlace expected = expect_place(at, dense.mu.segment<2>(row));
    J.block<2, 3>(2 * i, 0) = expected.J_x;
    J.block<2, 2>(2 * i, row) = expected.J_m;
    v.segment<2>(2 * i) = relocation.surroundings.p_robot.segment<2>(2 * i) - expected.p_robot;
  }
  const Eigen::MatrixXd weighted = J.transpose() * relocation.surroundings.covariance.inverse();
  dense.Omega += weighted * J;
  dense.mu += dense.Omega.ldlt().solve(weighted * v);
  return dense;
}

std::vector<int> rows_of(const std::vector<LandmarkEstimate>& map) {
  std::vector<int> rows;
  for (const LandmarkId id : {2, 3, 4, 5}) {
    for (std::size_t slot = 0; slot < map.size(); ++slot) {
      if (map[slot].landmark == id) rows.push_back(3 + 2 * static_cast<int>(slot));
    }
  }
  return rows;
}

Eigen::VectorXd means_of(const Estimator& filter) {
  const std::vector<LandmarkEstimate> map = filter.map();
  Eigen::VectorXd mu(3 + 2 * static_cast<Eigen::Index>(map.size()));
  mu.head<3>() << filter.pose().x, filter.pose().y, filter.pose().theta;
  for (std::size_t i = 0; i < map.size(); ++i)
    mu.segment<2>(3 + 2 * static_cast<Eigen::Index>(i)) = map[i].mean;
  return mu;
}

class RelocationOf : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Pose, RelocationOf, testing::Bool(),
                         [](const auto& keeps) { return keeps.param ? "Kept" : "Forgotten"; });

TEST_P(RelocationOf, TheEkfIsThatOfTheDenseInformation) {
  test::PathDrive way(two_rows(), {{0.0, 0.0}, {4.0, 0.0}}, 1);
  Ekf filter(way.setup());
  drive(filter, way);
  Relocation relocation = seen_from_there(filter, GetParam());
  if (GetParam()) relocation.T_world_robot = filter.pose();
  const Eigen::MatrixXd before = filter.Sigma().inverse();
  const Dense expected = relocated(before, filter.mu(), rows_of(filter.map()), relocation);
  filter.relocate(relocation);
  filter.measurement_update({.t = 100.0, .observations = {}}, nobody);
  const Eigen::MatrixXd Sigma = expected.Omega.inverse();
  EXPECT_LT((filter.Sigma() - Sigma).cwiseAbs().maxCoeff(), 1e-7 * Sigma.cwiseAbs().maxCoeff());
  if (!GetParam()) {
    EXPECT_LT((filter.mu() - expected.mu).cwiseAbs().maxCoeff(), 1e-7);
  }
  EXPECT_EQ(filter.counts().relocations, 1);
}

TEST(RelocationOfSeif, KeepsAllThatTheMapKnewAndNothingOfTheOldPose) {
  test::PathDrive way(two_rows(), {{0.0, 0.0}, {9.0, 0.0}}, 1);
  SeifOptions options;
  options.first_estimates = 0;
  options.tree.most_blocks = 0;
  options.tree.turns = false;
  Seif filter(way.setup(), options);
  drive(filter, way);
  LocalBelief& belief = *filter.local_belief();
  belief.begin_association(100.0);
  ASSERT_TRUE(belief.bring(std::vector<LandmarkId>{2, 3, 4, 5}));
  const Relocation relocation = seen_from_there(filter, false);
  const Dense expected =
      relocated(filter.whole_belief_matrix(), means_of(filter), rows_of(filter.map()), relocation);
  belief.relocate(relocation);
  filter.measurement_update({.t = 100.0, .observations = {}}, nobody);
  // Without the uncertainty of the start, which both leave out.
  EXPECT_LT((means_of(filter) - expected.mu).cwiseAbs().maxCoeff(), 1e-6);
  const Eigen::MatrixXd Omega = filter.whole_belief_matrix();
  ASSERT_EQ(Omega.rows(), expected.Omega.rows());
  EXPECT_LT((Omega - expected.Omega).cwiseAbs().maxCoeff(), 1e-8 * expected.Omega.cwiseAbs().maxCoeff());
  EXPECT_EQ(filter.counts().relocations, 1);
}

}  // namespace
}  // namespace seif
