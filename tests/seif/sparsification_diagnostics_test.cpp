// Quantities that show whether a sparsification makes the filter overconfident, and the filter's own
// diagnostics.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "driven_state.hpp"
#include "ring_drive.hpp"
#include "seif/full_state.hpp"
#include "seif/plain_seif.hpp"

namespace seif {
namespace {

using oracle::RandomDrive;
using test::start;

constexpr unsigned states = 20;
constexpr double from_inverses = 1e-9;  // [nat]

double log_determinant(const Eigen::MatrixXd& M) {
  return 2.0 * M.llt().matrixLLT().diagonal().array().log().sum();
}

/// log det of the pose's covariance. [nat]
double pose_uncertainty(const Eigen::MatrixXd& H) {
  return log_determinant(H.ldlt().solve(Eigen::MatrixXd::Identity(H.rows(), 3)).topRows<3>());
}

/// The state before and after the three landmarks seen longest ago were dropped.
struct Sparsified {
  Sparsified(unsigned seed, SparsificationRule rule) {
    InformationState state(start);
    RandomDrive random(seed);
    test::drive(state, random, 25);
    H = oracle::dense(state).H;
    mu = full_mu(state);
    for (int p = 0; p < state.active_count(); ++p) active.push_back(state.active(p));
    choose_to_drop(state, DropOrder::least_recently_seen, 3, dropped);
    anchoring = sparsify(state, rule, dropped);
    H_after = oracle::dense(state).H;
  }

  /// The belief over the window from which the rule takes p(x | Y+).
  Eigen::MatrixXd H0(SparsificationRule rule) const {
    switch (rule) {
      case SparsificationRule::report:
        return oracle::conditioned(H, active);
      case SparsificationRule::modified:
        return oracle::marginalised(H, active);
      case SparsificationRule::gauge_free:
        return oracle::floated(H, mu, active);
    }
    return {};
  }

  /// log det of the information of p(x | Y+), the dropped landmarks marginalised out of D = H0(rule).
  double log_det_Lambda(SparsificationRule rule) const {
    const Eigen::MatrixXd D = H0(rule);
    const Eigen::MatrixXd kept = D - oracle::taken_away(D, oracle::projection(D.rows(), false, dropped));
    return log_determinant(kept.topLeftCorner<3, 3>());
  }

  double change_of_uncertainty() const { return pose_uncertainty(H_after) - pose_uncertainty(H); }

  Eigen::MatrixXd H, H_after;
  Eigen::VectorXd mu;
  std::vector<int> active, dropped;
  std::optional<double> anchoring;
};

std::string name_of_rule(const testing::TestParamInfo<SparsificationRule>& rule) {
  const std::vector<std::string> names{"Report", "Modified", "GaugeFree"};
  return names[static_cast<std::size_t>(rule.param)];
}

class Diagnostics : public testing::TestWithParam<SparsificationRule> {};

INSTANTIATE_TEST_SUITE_P(Rules, Diagnostics,
                         testing::Values(SparsificationRule::report, SparsificationRule::modified,
                                         SparsificationRule::gauge_free),
                         name_of_rule);

TEST_P(Diagnostics, TheAnchoringLeftOutIsTheDenseDifferenceOfLogDeterminants) {
  for (unsigned seed = 1; seed <= states; ++seed) {
    const Sparsified by_rule(seed, GetParam());
    ASSERT_TRUE(by_rule.anchoring);
    const double expected =
        by_rule.log_det_Lambda(SparsificationRule::report) - by_rule.log_det_Lambda(GetParam());
    EXPECT_NEAR(*by_rule.anchoring, expected, from_inverses);
    if (GetParam() == SparsificationRule::report) {
      EXPECT_EQ(*by_rule.anchoring, 0.0);
    } else {
      EXPECT_GT(*by_rule.anchoring, 1e-3);
    }
  }
}

TEST_P(Diagnostics, TheUncertaintyOfThePoseChangesAsInTheDenseForm) {
  for (unsigned seed = 1; seed <= states; ++seed) {
    const Sparsified by_rule(seed, GetParam());
    const Eigen::MatrixXd expected = oracle::sparsified(by_rule.H, by_rule.H0(GetParam()), by_rule.dropped);
    EXPECT_NEAR(pose_uncertainty(by_rule.H_after), pose_uncertainty(expected), from_inverses);
  }
}

TEST(SparsificationDiagnostics,
     OfThePoseTheReportsRuleClaimsMoreTheModifiedAsMuchTheGaugeFreeOnAverageNoMore) {
  double gauge_free = 0.0;
  for (unsigned seed = 1; seed <= states; ++seed) {
    EXPECT_NEAR(Sparsified(seed, SparsificationRule::modified).change_of_uncertainty(), 0.0, from_inverses);
    EXPECT_LT(Sparsified(seed, SparsificationRule::report).change_of_uncertainty(), -0.01);
    gauge_free += Sparsified(seed, SparsificationRule::gauge_free).change_of_uncertainty() / states;
  }
  EXPECT_GT(gauge_free, 0.0);
}

/// Sum of r_i' Omega_ii^-1 r_i over robot and landmarks.
double dense_sum(const Eigen::MatrixXd& Omega, const Eigen::VectorXd& r) {
  double sum = r.head<3>().dot(Omega.topLeftCorner<3, 3>().llt().solve(r.head<3>()));
  for (Eigen::Index row = 3; row < r.size(); row += 2) {
    sum += r.segment<2>(row).dot(Omega.block<2, 2>(row, row).llt().solve(r.segment<2>(row)));
  }
  return sum;
}

TEST(MeanResidual, FollowsAStepOfTheWindow) {
  InformationState state(start);
  state.track_residual();
  RandomDrive random(4);
  test::drive(state, random, 25);
  state.move_window(Eigen::VectorXd::LinSpaced(state.window_size(), -0.1, 0.2));
  const double sum = dense_sum(oracle::dense(state).H, full_r(state));
  EXPECT_NEAR(state.squared_residual().value(), sum, 1e-9 * sum);
}

TEST(MeanResidual, IsTheDenseSumOverBlocksAndBoundsTheErrorOfTheMeanFromBelow) {
  test::RingDrive drive(100, 7);
  PlainSeif filter(drive.setup(), {});
  double largest = 0.0;
  for (int k = 0; k < 2 * drive.steps_for_a_round(); ++k) {
    drive.step(filter);
    if (k % 10 != 0) continue;
    const InformationState& state = filter.state();
    const Eigen::MatrixXd Omega = oracle::symmetric(full_Omega(state));
    const Eigen::VectorXd r = full_r(state);
    const double sum = dense_sum(Omega, r);
    int most_links = state.active_count();  // of one block; the robot's at first
    for (int i = 0; i < state.landmark_count(); ++i) {
      const int row = InformationState::row_of(i);
      int links = state.position(i) >= 0 ? 1 : 0;
      for (int j = 0; j < state.landmark_count(); ++j) {
        const bool linked = !Omega.block<2, 2>(row, InformationState::row_of(j)).isZero(0.0);
        if (j != i && linked) ++links;
      }
      most_links = std::max(most_links, links);
    }
    const double told = filter.counts().mean_residual.value();
    EXPECT_NEAR(told, sum, 1e-9 * (1.0 + sum)) << "update " << k;
    EXPECT_LE(told / (1 + most_links), r.dot(Omega.ldlt().solve(r)) * (1 + 1e-9)) << "update " << k;
    largest = std::max(largest, told);
  }
  EXPECT_GT(largest, 0.1);
}

}  // namespace
}  // namespace seif
