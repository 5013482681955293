// The default functions of the interface, and landmarks() of the filters that override it.
#include "seif/estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "every_filter.hpp"
#include "matrix_of.hpp"
#include "ring_drive.hpp"

namespace seif {
namespace {

using test::RingDrive;

/// Has a map, and only the functions that an estimator must have.
class MapAlone final : public Estimator {
 public:
  void motion_update(const Odometry&) override {}
  void measurement_update(const Scan&, const StageDone&) override {}
  Pose2 pose() const override { return {}; }
  Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<LandmarkEstimate> map() const override {
    ++maps_made;
    return {{7, {1.0, 2.0}}, {3, {3.0, 4.0}}, {40'000'000, {5.0, 6.0}}, {0, {7.0, 8.0}}};
  }
  std::optional<MarginalCovariances> marginal_covariances(std::span<const LandmarkId>) const override {
    return std::nullopt;
  }

  mutable int maps_made = 0;
};

std::vector<LandmarkEstimate> landmarks(const Estimator& filter, const std::vector<LandmarkId>& asked_for) {
  std::vector<LandmarkEstimate> out(3);  // must be replaced
  filter.landmarks(asked_for, out);
  return out;
}

TEST(Estimator, FindsLandmarksInOneMap) {
  const MapAlone filter;
  const auto found = landmarks(filter, {0, 5, 40'000'000, 3, 8, 3});
  EXPECT_EQ(filter.maps_made, 1);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].landmark, 0);
  EXPECT_EQ(found[0].mean, Eigen::Vector2d(7.0, 8.0));
  EXPECT_EQ(found[1].landmark, 40'000'000);
  EXPECT_EQ(found[1].mean, Eigen::Vector2d(5.0, 6.0));
  EXPECT_EQ(found[2].landmark, 3);
  EXPECT_EQ(found[3].landmark, 3);
  EXPECT_EQ(found[3].mean, Eigen::Vector2d(3.0, 4.0));
}

TEST(Estimator, MakesNoMapWhereNoLandmarkIsAskedFor) {
  const MapAlone filter;
  EXPECT_TRUE(landmarks(filter, {}).empty());
  EXPECT_EQ(filter.maps_made, 0);
}

TEST(Estimator, TellsOfNoMatrixUnlessItHasOne) {
  const MapAlone filter;
  EXPECT_EQ(filter.belief_matrix(), BeliefMatrix::none);
  std::vector<Coupling> couplings(3);
  filter.couplings(no_landmark, couplings);
  EXPECT_TRUE(couplings.empty());
  EXPECT_EQ(filter.whole_belief_matrix().size(), 0);
}

TEST(Estimator, TellsOfNoJointCovariancesUnlessItHasSome) { EXPECT_FALSE(MapAlone().joint_covariances({})); }

class LandmarksOf : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, LandmarksOf, testing::ValuesIn(test::every_filter()), test::name_of);

TEST_P(LandmarksOf, AreThoseOfTheMapInTheOrderAskedFor) {
  RingDrive drive(60, 8);
  const auto filter = test::make(GetParam(), drive.setup());
  EXPECT_TRUE(landmarks(*filter, {0, 1}).empty());
  for (int k = 0; k < drive.steps_for_a_round() / 2; ++k) drive.step(*filter);  // sees some of the landmarks

  std::vector<LandmarkId> asked_for;
  for (int k = 0; k < 60; ++k) asked_for.push_back(k * 7 % 60);
  asked_for.push_back(5'000);  // an id that no page of the index covers
  std::vector<LandmarkEstimate> expected;
  const std::vector<LandmarkEstimate> map = filter->map();
  for (const LandmarkId landmark : asked_for) {
    const auto found = std::ranges::find(map, landmark, &LandmarkEstimate::landmark);
    if (found != map.end()) expected.push_back(*found);
  }
  ASSERT_GT(expected.size(), 20U);
  ASSERT_LT(expected.size(), 60U);

  std::vector<LandmarkEstimate> by_default;
  filter->Estimator::landmarks(asked_for, by_default);
  for (const auto& found : {landmarks(*filter, asked_for), by_default}) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].landmark, expected[i].landmark);
      EXPECT_EQ(found[i].mean, expected[i].mean);  // to the bit
    }
  }
}

class WholeBeliefMatrix : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, WholeBeliefMatrix, testing::ValuesIn(test::every_filter()), test::name_of);

TEST_P(WholeBeliefMatrix, HasTheMarginalsAndTheCouplingsOfTheFilter) {
  RingDrive drive(60, 8);
  const EstimatorSetup setup = drive.setup();
  const auto filter = test::make(GetParam(), setup);
  for (int k = 0; k < drive.steps_for_a_round() / 2; ++k) drive.step(*filter);

  const Eigen::MatrixXd M = filter->whole_belief_matrix();
  std::vector<LandmarkId> ids;
  for (const LandmarkEstimate& estimate : filter->map()) ids.push_back(estimate.landmark);
  ASSERT_EQ(M.rows(), 3 + 2 * static_cast<Eigen::Index>(ids.size()));
  EXPECT_EQ(M, M.transpose());

  EXPECT_TRUE(M.isApprox(test::matrix_of(*filter), 1e-12));
  const Eigen::MatrixXd Sigma = test::covariance_of(*filter, setup.start);
  const auto marginals = filter->marginal_covariances(ids);
  ASSERT_TRUE(marginals);
  EXPECT_TRUE((Sigma.topLeftCorner<3, 3>().isApprox(marginals->pose, 1e-6)));
  std::vector<Coupling> couplings;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Eigen::Index row = 3 + 2 * static_cast<Eigen::Index>(i);
    EXPECT_TRUE((Sigma.block<2, 2>(row, row).isApprox(marginals->landmarks[i], 1e-6))) << ids[i];
    filter->couplings(ids[i], couplings);
    std::size_t linked = (M.block<2, 3>(row, 0).array() != 0.0).any() ? 1 : 0;
    for (std::size_t j = 0; j < ids.size(); ++j) {
      const Eigen::Index col = 3 + 2 * static_cast<Eigen::Index>(j);
      if (j != i && (M.block<2, 2>(row, col).array() != 0.0).any()) ++linked;
    }
    if (dynamic_cast<const Seif*>(filter.get()) != nullptr) {  // to turn an element fills it
      EXPECT_LE(couplings.size(), linked) << ids[i];
    } else {
      EXPECT_EQ(couplings.size(), linked) << ids[i];
    }
  }
}

}  // namespace
}  // namespace seif
