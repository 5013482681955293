// The joint covariances of the pose and landmarks, against the inverse of the whole matrix.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "driven_state.hpp"
#include "every_filter.hpp"
#include "matrix_of.hpp"
#include "ring_drive.hpp"
#include "seif/marginals.hpp"

namespace seif {
namespace {

/// The rows and columns of the pose and of the landmarks in these slots.
Eigen::MatrixXd joint_block(const Eigen::MatrixXd& Sigma, const std::vector<int>& slots) {
  std::vector<int> rows{0, 1, 2};
  for (const int slot : slots) rows.insert(rows.end(), {3 + 2 * slot, 4 + 2 * slot});
  return Sigma(rows, rows);
}

class JointCovariancesOf : public testing::TestWithParam<std::string> {
 protected:
  JointCovariancesOf() : setup(drive.setup()), filter(test::make(GetParam(), setup)) {
    for (int k = 0; k < 1.3 * drive.steps_for_a_round(); ++k) drive.step(*filter);
  }

  void expect_blocks_of(const Eigen::MatrixXd& Sigma, const std::vector<std::vector<int>>& slots) const {
    const std::vector<LandmarkEstimate> map = filter->map();
    std::vector<LandmarkIds> groups;
    for (const std::vector<int>& group : slots) {
      groups.emplace_back();
      for (const int slot : group) groups.back().push_back(map.at(static_cast<std::size_t>(slot)).landmark);
    }
    const auto joint = filter->joint_covariances(groups);
    ASSERT_TRUE(joint);
    ASSERT_EQ(joint->size(), slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const Eigen::MatrixXd expected = joint_block(Sigma, slots[i]);
      EXPECT_LT(((*joint)[i] - expected).norm(), 1e-8 * expected.norm()) << "group " << i;
    }
  }

  Eigen::MatrixXd Sigma() const { return test::covariance_of(*filter, setup.start); }

  test::RingDrive drive{test::under_sanitizer ? 40 : 60, 17};
  const EstimatorSetup setup;
  std::unique_ptr<Estimator> filter;
};

INSTANTIATE_TEST_SUITE_P(All, JointCovariancesOf, testing::ValuesIn(test::every_filter()), test::name_of);

TEST_P(JointCovariancesOf, AreBlocksOfTheDenseCovariance) {
  std::vector<int> all(filter->map().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(all.size() - 1 - i);
  std::vector<std::vector<int>> slots = {all, {3, 17, 4}, {}, {5, 2, 5}};
  for (const int slot : all) slots.push_back({slot});
  expect_blocks_of(Sigma(), slots);
}

TEST_P(JointCovariancesOf, HoldBetweenAMotionAndItsScan) {
  drive.advance();
  filter->motion_update(drive.odometry());
  expect_blocks_of(Sigma(), {{0}, {9, 30}});
}

TEST(JointCovariances, AreNothingWhereOmegaIsIndefinite) {
  oracle::RandomDrive random(21);
  InformationState state(test::start);
  test::drive(state, random, 7);
  const std::vector<LandmarkIds> one{{state.id(0)}};
  EXPECT_TRUE(joint_covariances_of(state, one));
  state.Omega()(0, 0) = -1.0;
  EXPECT_FALSE(joint_covariances_of(state, one));
}

}  // namespace
}  // namespace seif
