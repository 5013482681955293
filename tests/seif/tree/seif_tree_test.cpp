// Our filter with the condensation tree: the cost of an update, and its behaviour in a map that is too wide for
// the tree.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "allocation_counter.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/path_drive.hpp"
#include "seif/ring_drive.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

using test::RingDrive;

constexpr SeifOptions by_tree{.mean_recovery = MeanRecovery::tree};

/// Adds the blocks touched by each update of the second round.
void add_blocks_touched(int landmarks, int measured, unsigned seed, std::vector<std::int64_t>& blocks) {
  RingDrive drive(landmarks, seed);
  Seif filter(drive.setup(), by_tree);
  for (int k = 0; k < drive.steps_for_a_round() + 100; ++k) drive.step(filter);
  for (int k = 0; k < measured; ++k) {
    const std::int64_t before = filter.counts().blocks_touched;
    drive.step(filter);
    blocks.push_back(filter.counts().blocks_touched - before);
  }
}

/// The counts of several drives, sorted. Rings of other lengths, since the bursts of the sparsification come at other
/// places of the tree in each.
std::vector<std::int64_t> blocks_touched(int landmarks, int measured) {
  std::vector<std::int64_t> blocks;
  const unsigned drives = test::under_sanitizer ? 1 : 5;
  for (unsigned seed = 1; seed <= drives; ++seed)
    add_blocks_touched(landmarks + 3 * static_cast<int>(seed), measured, seed, blocks);
  std::ranges::sort(blocks);
  return blocks;
}

TEST(SeifByTree, TouchesAsManyBlocksInALargeMapAsInASmallOne) {
  constexpr int small_map = 1'000;  // in a smaller one no front is as large as it can be
  constexpr int measured = small_map * 3 / 2 - 200;
  const auto small = blocks_touched(small_map, measured);
  const auto large = blocks_touched(test::under_sanitizer ? 2'000 : 20'000, measured);
  const std::size_t median = small.size() / 2;
  const std::size_t p99 = small.size() * 99 / 100;
  EXPECT_LE(large[median], small[median] * 11 / 10);
  EXPECT_LE(large[p99], small[p99] * 11 / 10);
  EXPECT_LE(large.back(), 30'000);  // 20,000 for the next zone, a message of 200 unknowns, the window
}

/// The end of the first ring lies beside its beginning, 23 m off along the ring. The second is 60 m off.
TEST(SeifByTree, ClosesLongRings) {
  if (test::under_sanitizer) GTEST_SKIP() << "takes minutes there";
  constexpr struct {
    int landmarks;
    unsigned seed;
  } rings[] = {{1'400, 3}, {5'000, 2}};
  for (const auto& [landmarks, seed] : rings) {
    SCOPED_TRACE(landmarks);
    RingDrive drive(landmarks, seed);
    Seif filter(drive.setup(), by_tree);
    for (int k = 0; k < 2 * drive.steps_for_a_round() - 20; ++k) drive.step(filter);
    const Eigen::Vector3d error = drive.error_of(filter.pose());
    const Eigen::Matrix3d P = filter.pose_covariance().value();
    EXPECT_LT(error.dot(P.inverse() * error) / 3.0, 4.0);  // NEES: 1.6 and 1.0; frames that are fixed had 78
  }
}

/// Out along a lane, back along another one, and down to the first: it lies several metres beside where it was. The scan
/// is linearised after this closure. What the filter knew was linearised before it, and has to follow: otherwise the
/// difference looks like information about the heading of everything. The heading's standard deviation in that update,
/// against that of the whole belief: 0.86 to 1.00; where nothing followed, 0.82 to 0.94. Messages from outside the zone
/// follow with the next plan.
TEST(SeifByTree, AClosureTellsLittleOfHowTheWholeIsTurned) {
  if (test::under_sanitizer) GTEST_SKIP() << "takes minutes there";
  const test::Points path{{0, 0}, {360, 0}, {360, 12}, {60, 12}, {60, -2}};
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    test::PathDrive drive(test::landmarks_along(path, seed), path, seed);
    Seif filter(drive.setup(), by_tree);
    double farthest = 0.0;  // [m] that an update has moved the pose
    double ratio = 0.0;     // [-] of the standard deviations, in that update
    while (!drive.at_end()) {
      drive.advance();
      filter.motion_update(drive.odometry());
      const Pose2 before = filter.pose();
      filter.measurement_update(drive.scan(), test::ignore);
      const double jump = std::hypot(filter.pose().x - before.x, filter.pose().y - before.y);
      if (jump <= std::max(1.0, farthest)) continue;
      farthest = jump;
      const double whole = filter.marginal_covariances({})->pose(2, 2);
      ratio = std::sqrt((*filter.pose_covariance())(2, 2) / whole);
    }
    EXPECT_GT(farthest, 2.0);
    EXPECT_GT(ratio, 0.85);
  }
}

TEST(SeifByTree, IsTheSameToTheBitTheSecondTime) {
  RingDrive drive_a(200, 9);
  RingDrive drive_b(200, 9);
  Seif a(drive_a.setup(), by_tree);
  Seif b(drive_b.setup(), by_tree);
  for (int k = 0; k < 2 * drive_a.steps_for_a_round(); ++k) {
    drive_a.step(a);
    drive_b.step(b);
    ASSERT_EQ(a.pose().x, b.pose().x);
    ASSERT_EQ(a.pose().theta, b.pose().theta);
  }
  const auto map_a = a.map();
  const auto map_b = b.map();
  ASSERT_EQ(map_a.size(), map_b.size());
  for (std::size_t i = 0; i < map_a.size(); ++i) EXPECT_EQ(map_a[i].mean, map_b[i].mean);
}

/// A square that is covered in lanes of 4 m and then crossed: the boundaries of areas grow with the side of the
/// square.
test::PathDrive wide_drive(double side, int landmark_count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> anywhere(0.0, side);
  test::Points landmarks;
  for (int i = 0; i < landmark_count; ++i) landmarks.emplace_back(anywhere(random), anywhere(random));
  test::Points path;
  for (double y = 2.0; y < side; y += 8.0) {
    path.insert(path.end(), {{0, y}, {side, y}, {side, y + 4.0}, {0, y + 4.0}});
  }
  path.insert(path.end(), {{0, 0}, {side, side}});
  return {landmarks, path, 1};
}

/// Drives to the end.
void drive_all(Seif& filter, test::PathDrive drive) {
  while (!drive.at_end()) {
    drive.advance();
    filter.motion_update(drive.odometry());
    filter.measurement_update(drive.scan(), test::ignore);
  }
}

/// RMSE between two maps after aligning one to the other: the start's heading, which turns the whole map, has
/// an uncertainty of 1e-2.
double distance_of_shapes(const std::vector<LandmarkEstimate>& map,
                          const std::vector<LandmarkEstimate>& other) {
  const auto columns = [](const std::vector<LandmarkEstimate>& landmarks) {
    Eigen::Matrix2Xd means(2, landmarks.size());
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      means.col(static_cast<Eigen::Index>(i)) = landmarks[i].mean;
    }
    return means;
  };
  const Eigen::Matrix2Xd from = columns(map);
  const Eigen::Matrix2Xd to = columns(other);
  const Eigen::Matrix3d T = Eigen::umeyama(from, to, false);
  const Eigen::Matrix2Xd laid_over = (T.topLeftCorner<2, 2>() * from).colwise() + T.topRightCorner<2, 1>();
  return std::sqrt((laid_over - to).squaredNorm() / static_cast<double>(map.size()));
}

TEST(SeifByTree, InAWideMapGroupsSaveWorkAndHardlyMoveTheMap) {
  const double side = test::under_sanitizer ? 20.0 : 44.0;
  const int landmarks = test::under_sanitizer ? 150 : 480;
  SeifOptions with_groups = by_tree;
  with_groups.tree.most_blocks = 0;  // no observation waits, so both filters get the same observations
  SeifOptions without_groups = with_groups;
  without_groups.tree.most_unknowns = 1'000'000;
  const test::PathDrive drive = wide_drive(side, landmarks);
  Seif exact_filter(drive.setup(), without_groups);
  Seif grouped_filter(drive.setup(), with_groups);
  drive_all(exact_filter, drive);
  drive_all(grouped_filter, drive);
  EXPECT_LT(grouped_filter.counts().blocks_touched, exact_filter.counts().blocks_touched);
  const double moved = distance_of_shapes(grouped_filter.map(), exact_filter.map());
  EXPECT_GT(moved, 0.0);
  EXPECT_LT(moved, 1e-3);  // a twentieth of the noise of a range
}

}  // namespace
}  // namespace seif
