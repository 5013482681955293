// The rows of the matrices as the filters return them, against the whole matrix.
#include "seif/couplings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dense_oracle.hpp"
#include "driven_state.hpp"
#include "every_filter.hpp"
#include "matrix_of.hpp"
#include "ring_drive.hpp"
#include "seif/full_state.hpp"

namespace seif {
namespace {

using test::matrix_of;
using test::RingDrive;

using Row = std::map<LandmarkId, double>;  // strengths, by what the coupling leads to
using Rows = std::map<LandmarkId, Row>;    // no_landmark: the robot

/// Expects each coupling once.
Row as_row(const std::vector<Coupling>& couplings) {
  Row row;
  for (const Coupling& coupling : couplings) {
    EXPECT_TRUE(row.emplace(coupling.other, coupling.strength).second) << "landmark " << coupling.other;
  }
  return row;
}

/// The rows of the normalised matrix; `ids` by slot.
Rows rows_of(const Eigen::MatrixXd& M, const std::vector<LandmarkId>& ids) {
  const Eigen::VectorXd scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd normalised = scale.asDiagonal() * M * scale.asDiagonal();
  const auto begin = [](int slot) { return slot < 0 ? 0 : 3 + 2 * slot; };
  const auto size = [](int slot) { return slot < 0 ? 3 : 2; };
  const auto id = [&](int slot) { return slot < 0 ? no_landmark : ids[static_cast<std::size_t>(slot)]; };
  Rows rows;
  for (int a = -1; a < static_cast<int>(ids.size()); ++a) {
    Row& row = rows[id(a)];
    for (int b = -1; b < static_cast<int>(ids.size()); ++b) {
      if (a == b) continue;
      const double strength = normalised.block(begin(a), begin(b), size(a), size(b)).cwiseAbs().maxCoeff();
      if (strength > 0.0) row[id(b)] = strength;
    }
  }
  return rows;
}

void expect_equal(const Row& told, const Row& expected) {
  ASSERT_EQ(told.size(), expected.size());
  for (const auto& [other, strength] : expected) {
    ASSERT_TRUE(told.contains(other)) << "landmark " << other;
    EXPECT_NEAR(told.at(other), strength, 1e-12);
  }
}

std::vector<LandmarkId> ids_of(const std::vector<LandmarkEstimate>& map) {
  std::vector<LandmarkId> ids;
  for (const LandmarkEstimate& landmark : map) ids.push_back(landmark.landmark);
  return ids;
}

TEST(Couplings, AreTheRowsOfAStateWithLinksOfEveryKind) {
  oracle::RandomDrive random(21);
  InformationState state(test::start);
  int in_window = 0;  // links of active landmarks
  int to_passive = 0;
  int among_passive = 0;
  for (int stretch = 0; stretch < 10; ++stretch) {
    test::drive(state, random, 7);
    std::vector<LandmarkId> ids;
    for (int slot = 0; slot < state.landmark_count(); ++slot) ids.push_back(state.id(slot));
    std::vector<Coupling> couplings;
    for (const auto& [of, expected] : rows_of(oracle::symmetric(full_Omega(state)), ids)) {
      couplings_of(state, of, couplings);
      expect_equal(as_row(couplings), expected);
      if (of == no_landmark) {
        EXPECT_EQ(couplings.size(), static_cast<std::size_t>(state.active_count()));
        continue;
      }
      const bool is_active = state.position(*state.find(of)) >= 0;
      for (const Coupling& coupling : couplings) {
        if (coupling.other == no_landmark) continue;
        const bool other_is_active = state.position(*state.find(coupling.other)) >= 0;
        ++(is_active && other_is_active   ? in_window
           : is_active || other_is_active ? to_passive
                                          : among_passive);
      }
    }
  }
  EXPECT_GT(in_window, 0);
  EXPECT_GT(to_passive, 0);
  EXPECT_GT(among_passive, 0);
}

TEST(Couplings, LeaveOutLinksWhoseBlockIsZero) {
  InformationState state(test::start);
  for (const LandmarkId landmark : {4, 9}) state.activate(state.add_landmark(landmark, {1.0, 2.0}));
  state.Omega().bottomRightCorner<4, 4>().setIdentity();
  std::vector<Coupling> couplings;
  for (const LandmarkId of : {no_landmark, 4, 9}) {
    couplings_of(state, of, couplings);
    EXPECT_TRUE(couplings.empty());
  }
  state.Omega()(3, 6) = state.Omega()(6, 3) = -0.25;
  for (int position = 1; position >= 0; --position) state.deactivate(position);  // the link now has a block
  couplings_of(state, 4, couplings);
  EXPECT_EQ(as_row(couplings), (Row{{9, 0.25}}));
  for (const int slot : {0, 1}) state.activate(slot);
  state.Omega()(3, 6) = state.Omega()(6, 3) = 0.0;
  for (int position = 1; position >= 0; --position) state.deactivate(position);  // which is zero
  couplings_of(state, 4, couplings);
  EXPECT_TRUE(couplings.empty());
}

/// Robot and one landmark, from a dense matrix.
double strength_of_link(const Eigen::Matrix<double, 5, 5>& M) {
  LandmarkIndex index;
  index.insert(8, 0);
  const std::vector<LandmarkId> ids{8};
  std::vector<Coupling> of_robot;
  std::vector<Coupling> of_landmark;
  couplings_of(M, index, ids, no_landmark, of_robot);
  couplings_of(M, index, ids, 8, of_landmark);
  EXPECT_EQ(as_row(of_landmark).begin()->second, as_row(of_robot).begin()->second);
  return as_row(of_robot).at(8);
}

TEST(Couplings, AreTheLargestNormalisedEntryOfTheBlock) {
  Eigen::Matrix<double, 5, 5> M = Eigen::Matrix<double, 5, 5>::Identity();
  M.diagonal() << 1.0, 4.0, 9.0, 16.0, 25.0;
  M(3, 0) = 1.0;   // / (1 * 4)
  M(4, 2) = -6.0;  // / (3 * 5)
  EXPECT_DOUBLE_EQ(strength_of_link(M), 0.4);
}

TEST(Couplings, AreAtMostOneInAMatrixThatIsNotPositiveDefinite) {
  Eigen::Matrix<double, 5, 5> M = Eigen::Matrix<double, 5, 5>::Identity();
  M(4, 1) = 1.0 + std::numeric_limits<double>::epsilon();
  EXPECT_EQ(strength_of_link(M), 1.0);
  for (const double diagonal : {0.0, -1.0}) {
    M(1, 1) = diagonal;
    EXPECT_EQ(strength_of_link(M), 1.0);
  }
}

class CouplingsOf : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Estimator> driven(double rounds, bool is_fixed = false) {
    std::unique_ptr<Estimator> filter = test::make(GetParam(), drive.setup(), false, is_fixed);
    for (int k = 0; k < rounds * drive.steps_for_a_round(); ++k) drive.step(*filter);
    return filter;
  }

  static constexpr int ring = test::under_sanitizer ? 40 : 60;  // [-] landmarks
  RingDrive drive{ring, 17};
};

INSTANTIATE_TEST_SUITE_P(All, CouplingsOf, testing::ValuesIn(test::every_filter()), test::name_of);

/// Links are shown as they were frozen; the matrix would have them turned.
TEST_P(CouplingsOf, AreTheRowsOfTheMatrix) {
  constexpr bool is_fixed = true;
  const std::unique_ptr<Estimator> filter = driven(1.3, is_fixed);
  EXPECT_EQ(filter->belief_matrix(),
            GetParam() == "ekf" ? BeliefMatrix::covariance : BeliefMatrix::information);
  std::vector<Coupling> couplings(3);  // must be replaced
  for (const auto& [of, expected] : rows_of(matrix_of(*filter), ids_of(filter->map()))) {
    filter->couplings(of, couplings);
    expect_equal(as_row(couplings), expected);
    for (const Coupling& coupling : couplings) EXPECT_LE(coupling.strength, 1.0);
  }
  filter->couplings(no_landmark, couplings);
  EXPECT_EQ(couplings.size(), static_cast<std::size_t>(filter->counts().active_landmarks));
}

TEST_P(CouplingsOf, AreTheSameFromBothEnds) {
  const std::unique_ptr<Estimator> filter = driven(1.3);
  std::vector<LandmarkId> nodes = ids_of(filter->map());
  nodes.push_back(no_landmark);
  Rows rows;
  std::vector<Coupling> couplings;
  for (const LandmarkId of : nodes) {
    filter->couplings(of, couplings);
    rows[of] = as_row(couplings);
  }
  std::size_t links = 0;
  for (const auto& [of, row] : rows) {
    EXPECT_FALSE(row.contains(of));
    for (const auto& [other, strength] : row) EXPECT_EQ(rows.at(other).at(of), strength);  // to the bit
    links += row.size();
  }
  // A link whose block has become zero still counts.
  EXPECT_LE(links / 2, static_cast<std::size_t>(filter->counts().links));
  EXPECT_GT(links / 2, static_cast<std::size_t>(filter->counts().links) * 9 / 10);
}

TEST_P(CouplingsOf, AreNoneForALandmarkThatIsNotInTheMap) {
  const std::unique_ptr<Estimator> filter = driven(0.2);
  for (const LandmarkId unknown : {ring / 2, 5'000}) {  // across the ring; in none of the index's pages
    std::vector<Coupling> couplings(3);
    filter->couplings(unknown, couplings);
    EXPECT_TRUE(couplings.empty());
  }
}

TEST_P(CouplingsOf, AndLandmarksAreReadWithoutATrace) {
  const auto read = test::make(GetParam(), drive.setup());
  const auto left_alone = test::make(GetParam(), drive.setup());
  std::vector<LandmarkId> all(ring);
  for (int landmark = 0; landmark < ring; ++landmark) all[static_cast<std::size_t>(landmark)] = landmark;
  std::vector<LandmarkEstimate> means;
  std::vector<Coupling> couplings;
  for (int k = 0; k < 1.3 * drive.steps_for_a_round(); ++k) {
    drive.advance();
    for (Estimator* filter : {read.get(), left_alone.get()}) {
      filter->motion_update(drive.odometry());
      filter->measurement_update(drive.scan(), test::ignore);
    }
    read->landmarks(all, means);
    read->couplings(no_landmark, couplings);
    for (const LandmarkId landmark : all) read->couplings(landmark, couplings);
    ASSERT_EQ(read->pose().x, left_alone->pose().x) << "step " << k;
    ASSERT_EQ(read->pose().y, left_alone->pose().y);
    ASSERT_EQ(read->pose().theta, left_alone->pose().theta);
    ASSERT_EQ(read->counts().blocks_touched, left_alone->counts().blocks_touched);
  }
  const auto map_read = read->map();
  const auto map_left_alone = left_alone->map();
  ASSERT_EQ(map_read.size(), map_left_alone.size());
  for (std::size_t i = 0; i < map_read.size(); ++i) EXPECT_EQ(map_read[i].mean, map_left_alone[i].mean);
  EXPECT_EQ(matrix_of(*read), matrix_of(*left_alone));
}

}  // namespace
}  // namespace seif
