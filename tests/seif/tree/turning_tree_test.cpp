// What was frozen turns with the part of the map that it is in: the tree where closures turn the map, against the sum
// of all elements at the same places.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <vector>

#include "seif/full_state.hpp"
#include "seif/linearisation.hpp"
#include "seif/measurement_steps.hpp"
#include "seif/motion_update.hpp"
#include "seif/observation_factor.hpp"
#include "seif/path_drive.hpp"
#include "seif/sparsification.hpp"
#include "seif/start_points.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {
namespace {

using test::Points;

/// Small leaves, which give deep trees in small worlds; no group is ever made.
constexpr CondensationOptions turning_deep{.most_in_leaf = 4, .most_hot = 10, .most_unknowns = 100'000};

/// A filter with a tree, without the steps of Seif that do not concern it.
struct TurningTree {
  explicit TurningTree(const PoseEstimate& start) : state(start), tree(turning_deep, start.mean) {
    state.keep_frozen_apart();
    state.first_estimates().settle_after(5);
    state.first_estimates().note_sighting_sd(0.04);  // [m] the noise of PathDrive
    relate_to_start(state, start.covariance);
    tree.hold(state, std::array{0, 1}, start_point_sd);
  }

  void update(const Odometry& odometry, const Scan& scan) {
    motion_update(state, odometry);
    std::vector<int> slots;
    double range = 0.0;
    for (const Observation& z : scan.observations) {
      range = std::max(range, z.range);
      if (const auto slot = state.find(z.landmark)) slots.push_back(*slot);
    }
    state.begin_scan();
    ASSERT_TRUE(tree.activate(state, slots, range));
    for (const int slot : slots) state.mark_seen(slot);
    std::vector<ObservationFactor> factors;
    linearise_known(state, scan, {}, 0.5, factors);
    for (const ObservationFactor& factor : factors) add(state, factor);
    ASSERT_TRUE(tree.solve_window(state));
    for (const Observation& z : scan.observations) {
      if (state.find(z.landmark)) continue;
      const Eigen::Vector2d p = invert_observation(state.pose(), {}, z).p_world_landmark;
      const int slot = state.add_landmark(z.landmark, p);
      tree.join(state, slot);
      state.mark_seen(slot);
      add(state, linearise(state, slot, z, {}));
    }
    update_first_estimates(state);
    freeze_surplus();
    ASSERT_TRUE(tree.solve_window(state));
    ASSERT_TRUE(tree.end_update(state));
  }

  void freeze_surplus() {
    std::vector<int> dropped;
    choose_surplus(state, {.theta_x = 6, .theta_max = 16}, dropped);
    if (dropped.empty()) return;
    ASSERT_TRUE(sparsify(state, SparsificationRule::gauge_free, dropped));
    FrozenPiece piece;
    ASSERT_TRUE(freeze(state, dropped, piece));
    ASSERT_TRUE(tree.freeze(state, piece));
  }

  /// Of window and elements, with all of them where they are now. (3+2N)
  Eigen::VectorXd residual() const {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(InformationState::row_of(state.landmark_count()));
    const FrozenInformation frozen = tree.frozen_information(state);
    r.tail(frozen.r.size()) = frozen.r;
    r.head<3>() += state.r().head<3>();
    for (int p = 0; p < state.active_count(); ++p)
      r.segment<2>(InformationState::row_of(state.active(p))) +=
          state.r().segment<2>(InformationState::row_of(p));
    return r;
  }

  /// Of the pose, from the sum of window and elements. (3 x 3)
  Eigen::Matrix3d pose_covariance() const {
    std::vector<Eigen::Triplet<double>> entries = window_entries(state);
    for (const FrozenInformation::Block& block : tree.frozen_information(state).blocks) {
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
          const int row = InformationState::row_of(block.slot) + i;
          const int col = InformationState::row_of(block.other) + j;
          if (block.slot == block.other && j > i) continue;
          entries.emplace_back(std::max(row, col), std::min(row, col), block.Omega(i, j));
        }
      }
    }
    const int n = InformationState::row_of(state.landmark_count());
    Eigen::SparseMatrix<double> Omega(n, n);
    Omega.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(Omega);
    return solver.solve(Eigen::MatrixXd::Identity(n, 3)).topRows<3>();
  }

  /// Of the pose, by the latest solution. (3 x 3)
  Eigen::Matrix3d covariance_by_window() const {
    const WindowFactor& factor = tree.window_factor();
    const Eigen::MatrixXd Y =
        factor.L().triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(factor.size, 3));
    return Y.transpose() * Y;
  }

  InformationState state;
  CondensationTree tree;
};

/// `rounds` rounds along a polygon of sixteen corners.
Points ring(double radius, double rounds) {
  Points corners;
  for (int i = 0; i <= 16 * rounds; ++i)
    corners.push_back(
        radius * Eigen::Vector2d(std::cos(i * std::numbers::pi / 8), std::sin(i * std::numbers::pi / 8)));
  return corners;
}

const Points serpentine{{0, 0}, {24, 0}, {24, 4}, {0, 4}, {0, 8}, {24, 8}, {24, 12}, {0, 12}, {0, 0}, {8, 6}};

/// To the end of the drive; calls after_update(it) after each update.
template <class AfterUpdate>
void drive_all(TurningTree& it, test::PathDrive& drive, const AfterUpdate& after_update) {
  while (!drive.at_end()) {
    drive.advance();
    it.update(drive.odometry(), drive.scan());
    after_update(it);
  }
}

void drive_all(TurningTree& it, test::PathDrive& drive) {
  drive_all(it, drive, [](const TurningTree&) {});
}

void expect_no_pull(const TurningTree& it) {
  Eigen::VectorXd r = it.residual();
  r.segment<4>(3).setZero();  // the start points' places are so well known that only rounding is left
  EXPECT_LT(r.cwiseAbs().maxCoeff(), 1e-5);  // one more observation changes r by about 1e3
}

/// After the drive, all messages are sent until nothing moves any more.
void settle(TurningTree& it) {
  for (int k = 0; k < 10; ++k) ASSERT_TRUE(it.tree.solve_all(it.state));
}

TEST(TurningTree, TheMeanIsWhereNothingPulls) {
  int drives = 0;
  for (const Points& path : {ring(9.0, 2.3), ring(25.0, 1.4), serpentine}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(testing::Message() << "drive " << drives++);
      test::PathDrive drive(test::landmarks_along(path, seed), path, seed);
      TurningTree it(drive.setup().start);
      drive_all(it, drive, [](const TurningTree& driven) {
        ASSERT_EQ(driven.tree.broken_invariant(driven.state), std::nullopt);
      });
      settle(it);
      expect_no_pull(it);
    }
  }
}

TEST(TurningTree, ThePoseIsKnownAsTheSumOfAllElementsSays) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const Points path = ring(15.0, 1.3);
    test::PathDrive drive(test::landmarks_along(path, seed), path, seed);
    TurningTree it(drive.setup().start);
    drive_all(it, drive);
    settle(it);
    const Eigen::Matrix3d expected = it.pose_covariance();
    EXPECT_LT((it.covariance_by_window() - expected).norm(), 1e-5 * expected.norm());
  }
}

/// What the zone knows is taken apart and put together again.
TEST(TurningTree, CarryingToWhereEverythingIsChangesNothing) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const Points path = ring(15.0, 1.3);
    test::PathDrive drive(test::landmarks_along(path, seed), path, seed);
    TurningTree it(drive.setup().start);
    drive_all(it, drive);
    settle(it);
    const Pose2 pose = it.state.pose();
    const Eigen::Matrix3d P = it.covariance_by_window();
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(it.tree.carry(it.state));
      ASSERT_EQ(it.tree.broken_invariant(it.state), std::nullopt);
      ASSERT_TRUE(it.tree.solve_window(it.state));
    }
    EXPECT_NEAR(it.state.pose().x, pose.x, 1e-6);
    EXPECT_NEAR(it.state.pose().y, pose.y, 1e-6);
    EXPECT_NEAR(it.state.pose().theta, pose.theta, 1e-7);
    EXPECT_LT((it.covariance_by_window() - P).norm(), 1e-5 * P.norm());
  }
}

/// At every update, also while a plan is made.
TEST(TurningTree, CarryingLeavesTheMeanWhereNothingPulls) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const Points path = ring(25.0, 1.4);
    test::PathDrive drive(test::landmarks_along(path, seed), path, seed);
    TurningTree it(drive.setup().start);
    drive_all(it, drive, [](TurningTree& driven) {
      ASSERT_TRUE(driven.tree.carry(driven.state));
      ASSERT_EQ(driven.tree.broken_invariant(driven.state), std::nullopt);
    });
    settle(it);
    expect_no_pull(it);
  }
}

/// The same drive from another start: everything lies elsewhere and is turned, and nothing else differs.
TEST(TurningTree, WhereTheWholeLiesChangesNothing) {
  const Points path = ring(15.0, 1.5);
  const Points landmarks = test::landmarks_along(path, 3);
  const Pose2 elsewhere{-400.0, 250.0, 2.5};
  std::deque<TurningTree> trees;
  for (const Pose2& frame : {Pose2{}, elsewhere}) {
    test::PathDrive drive(landmarks, path, 3);
    PoseEstimate start = drive.setup().start;
    start.mean = frame * start.mean;
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(frame.theta).toRotationMatrix();
    start.covariance.topLeftCorner<2, 2>() = R * start.covariance.topLeftCorner<2, 2>() * R.transpose();
    drive_all(trees.emplace_back(start), drive);
  }
  double apart = 0.0;
  for (int slot = 2; slot < trees[0].state.landmark_count(); ++slot) {
    const Eigen::Vector2d moved = elsewhere * trees[0].tree.mean(trees[0].state, slot);
    apart = std::max(apart, (trees[1].tree.mean(trees[1].state, slot) - moved).norm());
  }
  EXPECT_LT(apart, 1e-5);  // [m] the cells of the tree lie elsewhere, so fronts differ; only rounding may
}

}  // namespace
}  // namespace seif
