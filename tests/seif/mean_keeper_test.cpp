#include "seif/mean_keeper.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "ring_drive.hpp"
#include "seif/exact_mean.hpp"
#include "seif/full_state.hpp"
#include "seif/groups/group_mean.hpp"
#include "seif/seif.hpp"
#include "seif/tree/tree_mean.hpp"

namespace seif {
namespace {

/// The three implementations stand side by side.
class EachMeanKeeper : public testing::TestWithParam<MeanRecovery> {};
std::string name_of(const testing::TestParamInfo<MeanRecovery>& info) {
  if (info.param == MeanRecovery::tree) return "tree";
  return info.param == MeanRecovery::exact ? "exact" : "multilevel";
}

INSTANTIATE_TEST_SUITE_P(Recoveries, EachMeanKeeper,
                         testing::Values(MeanRecovery::tree, MeanRecovery::multilevel, MeanRecovery::exact),
                         name_of);

std::unique_ptr<MeanKeeper> keeper_of(MeanRecovery recovery) {
  if (recovery == MeanRecovery::tree) return std::make_unique<TreeMean>(CondensationOptions{}, Pose2{});
  if (recovery == MeanRecovery::multilevel) return std::make_unique<GroupMean>(MultilevelOptions{});
  return std::make_unique<ExactMean>();
}

/// A map that fits into the window whole: there is nothing to approximate.
TEST_P(EachMeanKeeper, FindsTheMeanOfASmallMap) {
  test::RingDrive drive(12, 3);
  SeifOptions options;
  options.mean_recovery = GetParam();
  options.theta_x = 20;
  options.theta_max = 20;
  Seif filter(drive.setup(), options);
  for (int step = 0; step < 2 * drive.steps_for_a_round(); ++step) drive.step(filter);
  ASSERT_EQ(filter.map().size(), 12u);
  EXPECT_LT(full_r(filter.state()).norm(), 1e-6);
}

/// A robot and a landmark that it has never seen, whose information somebody has broken.
TEST_P(EachMeanKeeper, TellsOfAMatrixThatIsNotPositiveDefinite) {
  for (const bool broken : {false, true}) {
    InformationState state({.mean = {}, .covariance = 0.01 * Eigen::Matrix3d::Identity()});
    const std::unique_ptr<MeanKeeper> keeper = keeper_of(GetParam());
    std::vector<int> none;
    state.begin_scan();
    ASSERT_TRUE(keeper->activate(state, none, 0.0));
    ASSERT_TRUE(keeper->before_information(state));
    if (broken) state.Omega()(0, 0) = -1.0;
    EXPECT_EQ(keeper->solve_window(state), !broken);
  }
}

}  // namespace
}  // namespace seif
