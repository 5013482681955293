// Drives without names: what ekf and seif make of them.
#include "seif/associating_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "allocation_counter.hpp"
#include "dense_oracle.hpp"
#include "path_drive.hpp"
#include "ring_drive.hpp"
#include "seif/ekf.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

using test::ignore;
using test::RingDrive;

std::unique_ptr<AssociableFilter> named_filter(const std::string& type, const EstimatorSetup& setup,
                                               const SeifOptions& options = {}) {
  if (type == "ekf") return std::make_unique<Ekf>(setup);
  return std::make_unique<Seif>(setup, options);
}

Scan nameless(Scan scan) {
  for (Observation& observation : scan.observations) observation.landmark = no_landmark;
  return scan;
}

/// What became of a drive, by the true names.
struct Outcome {
  int named = 0, left_out = 0, wrong = 0;
  std::map<LandmarkId, LandmarkId> true_of;  // by name: of its first observation

  void add(const Scan& scan, std::span<const LandmarkId> names) {
    ASSERT_EQ(names.size(), scan.observations.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == no_landmark) {
        ++left_out;
        continue;
      }
      ++named;
      const LandmarkId truth = scan.observations[i].landmark;
      if (true_of.try_emplace(names[i], truth).first->second != truth) ++wrong;
    }
  }
  std::set<LandmarkId> mapped(const Estimator& filter) const {
    std::set<LandmarkId> mapped;
    for (const LandmarkEstimate& landmark : filter.map()) mapped.insert(true_of.at(landmark.landmark));
    return mapped;
  }
};

class Associating : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  std::unique_ptr<AssociatingFilter> make(const EstimatorSetup& setup,
                                          AssociationOptions options = {}) const {
    options.jointly = std::get<1>(GetParam());
    return std::make_unique<AssociatingFilter>(named_filter(std::get<0>(GetParam()), setup), setup, options);
  }
};

INSTANTIATE_TEST_SUITE_P(Filters, Associating,
                         testing::Combine(testing::Values("ekf", "seif"), testing::Bool()),
                         [](const auto& test) {
                           return std::get<0>(test.param) + (std::get<1>(test.param) ? "Jointly" : "Nearest");
                         });

TEST_P(Associating, FindsEachLandmarkOfARingAgainAndAgain) {
  constexpr int landmarks = 120;
  RingDrive drive(landmarks, 1);
  const auto filter = make(drive.setup());
  Outcome outcome;
  for (int step = 0; step < 2 * drive.steps_for_a_round() + 40; ++step) {
    drive.advance();
    filter->motion_update(drive.odometry());
    filter->measurement_update(nameless(drive.scan()), ignore);
    outcome.add(drive.scan(), filter->associations());
  }
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_LE(outcome.left_out, 4 * landmarks) << "two for each before it joins, and one in a thousand";
  EXPECT_EQ(filter->map().size(), static_cast<std::size_t>(landmarks)) << "none twice";
  EXPECT_EQ(outcome.mapped(*filter).size(), static_cast<std::size_t>(landmarks));
}

TEST_P(Associating, FalseDetectionsDoNotJoinTheMap) {
  RingDrive drive(60, 2);
  const auto filter = make(drive.setup());
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Outcome outcome;
  for (int step = 0; step < 2 * drive.steps_for_a_round(); ++step) {
    drive.advance();
    Scan scan = drive.scan();
    scan.observations.push_back({.landmark = 1000 + step, .range = 2.5 + 1.5 * uniform(random)});
    scan.observations.back().bearing = 3.0 * uniform(random);
    scan.observations.back().covariance.diagonal() << 4e-4, 1e-4;
    filter->motion_update(drive.odometry());
    filter->measurement_update(nameless(scan), ignore);
    outcome.add(scan, filter->associations());
  }
  EXPECT_EQ(filter->map().size(), 60U);
  EXPECT_LE(outcome.wrong, outcome.named / 200) << "false ones beside a landmark";
}

TEST_P(Associating, WhatIsNotThereAnyMoreIsTakenOut) {
  RingDrive drive(60, 3);
  const auto filter = make(drive.setup(), {.remove_below = 0.3});
  Outcome outcome;
  std::size_t most = 0;
  for (int step = 0; step < 6 * drive.steps_for_a_round(); ++step) {
    drive.advance();
    Scan scan = drive.scan();
    if (step > drive.steps_for_a_round()) {
      std::erase_if(scan.observations, [](const Observation& z) { return z.landmark % 10 == 4; });
    }
    filter->motion_update(drive.odometry());
    filter->measurement_update(nameless(scan), ignore);
    outcome.add(scan, filter->associations());
    most = std::max(most, filter->map().size());
  }
  EXPECT_EQ(most, 60U);
  const std::set<LandmarkId> mapped = outcome.mapped(*filter);
  EXPECT_EQ(mapped.size(), 54U);
  for (const LandmarkId id : mapped) EXPECT_NE(id % 10, 4);
  EXPECT_EQ(filter->whole_belief_matrix().rows(), 3 + 2 * 54);
}

// With gates so narrow that landmarks are taken for new ones time and again.
TEST_P(Associating, TwoThatAreOneAreMerged) {
  constexpr int landmarks = 40;
  RingDrive drive(landmarks, 4);
  const auto filter =
      make(drive.setup(), {.match_probability = 0.03, .new_probability = 0.02, .admit_after = 1});
  std::set<LandmarkId> names;
  for (int step = 0; step < 6 * drive.steps_for_a_round(); ++step) {
    drive.advance();
    filter->motion_update(drive.odometry());
    filter->measurement_update(nameless(drive.scan()), ignore);
    for (const LandmarkId name : filter->associations()) names.insert(name);
  }
  EXPECT_GT(names.size(), landmarks + 10U) << "otherwise there was nothing to merge";
  EXPECT_LE(filter->map().size(), landmarks + (names.size() - landmarks) / 4);
}

// The window with what hub and messages know, and how the others of the zone follow: by the inverse of all of
// Omega.
TEST(SeifCovariance, IsThatOfTheWholeInformationMatrix) {
  RingDrive drive(120, 5);
  SeifOptions options;
  options.tree.most_unknowns = 1'000'000;  // no groups: these are an approximation
  Seif filter(drive.setup(), options);
  int passive = 0;
  for (int step = 0; step < drive.steps_for_a_round() + 60; ++step) {
    drive.step(filter);
    if (step % 10 != 0) continue;
    filter.begin_association(0.0);
    std::vector<LandmarkId> ids;
    filter.landmarks_at_hand(ids);
    const auto n = static_cast<Eigen::Index>(3 + 2 * ids.size());
    Eigen::MatrixXd P(n, n);
    filter.covariance_with(ids, P);
    const Eigen::MatrixXd all = oracle::symmetric(filter.state().full_Omega()).inverse();
    Eigen::VectorXi rows(n);
    rows.head<3>() << 0, 1, 2;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const int slot = filter.state().find(ids[i]).value();
      const auto at = static_cast<Eigen::Index>(3 + 2 * i);
      rows.segment<2>(at) << 3 + 2 * slot, 4 + 2 * slot;
      passive += filter.state().position(slot) < 0;
    }
    ASSERT_LT((P - all(rows, rows)).norm(), 1e-7 * all(rows, rows).norm()) << step;
  }
  EXPECT_GT(passive, 100) << "otherwise only the window was tested";
}

/// m_a = m_b by conditioning the joint Gaussian.
class Equate : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Filters, Equate, testing::Values("ekf", "seif"),
                         [](const auto& filter) { return filter.param; });

TEST_P(Equate, ConditionsTheBelief) {
  RingDrive drive(40, 6);
  SeifOptions options;
  options.first_estimates = 0;  // no null space to keep
  options.tree.most_unknowns = 1'000'000;
  const auto filter = named_filter(GetParam(), drive.setup(), options);
  for (int step = 0; step < 30; ++step) {
    drive.advance();
    filter->motion_update(drive.odometry());
    filter->measurement_update(drive.scan(), ignore);
  }
  const LandmarkIds ids = {drive.scan().observations.at(0).landmark,
                           drive.scan().observations.at(1).landmark};
  const std::vector<LandmarkIds> groups = {ids};
  const Eigen::MatrixXd P = filter->joint_covariances(groups)->front();
  std::vector<LandmarkEstimate> before;
  filter->landmarks(ids, before);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2, 7);
  J.block<2, 2>(0, 3).setIdentity();
  J.block<2, 2>(0, 5) = -Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d S = J * P * J.transpose() + equal_sd * equal_sd * Eigen::Matrix2d::Identity();
  const Eigen::MatrixXd K = P * J.transpose() * S.inverse();
  const Eigen::VectorXd d = K * (before[1].mean - before[0].mean);
  const Pose2 pose = filter->pose();

  filter->equate(ids[0], ids[1]);
  filter->measurement_update({drive.scan().t, {}}, ignore);
  std::vector<LandmarkEstimate> after;
  filter->landmarks(ids, after);
  EXPECT_NEAR(filter->pose().x, pose.x + d(0), 1e-6);
  EXPECT_NEAR(filter->pose().theta, pose.theta + d(2), 1e-6);
  EXPECT_LT((after[0].mean - before[0].mean - d.segment<2>(3)).norm(), 1e-6);
  EXPECT_LT((after[1].mean - before[1].mean - d.segment<2>(5)).norm(), 1e-6);
  const Eigen::MatrixXd P_after = filter->joint_covariances(groups)->front();
  EXPECT_LT((P_after - (P - K * J * P)).norm(), 1e-6 * P.norm());
}

// As the rest of seif: the same work and no allocation in a map of any size.
constexpr double to_and_fro = 60.0;  // [m]

struct Work {
  std::int64_t blocks = 0;
  long allocations = 0;
};

/// Two uneven rows of trees: out along them, and then to and fro along the last part.
test::PathDrive drive_to_and_fro(double length, int rounds) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  test::Points trees;
  for (double x = -4.0; x < length + 4.0; x += 1.5) {
    for (const double y : {-1.8, 1.8}) trees.emplace_back(x + uniform(random), y + uniform(random));
  }
  test::Points corners = {{0.0, 0.0}};
  for (int i = 0; i < rounds; ++i) corners.insert(corners.end(), {{length, 0.0}, {length - to_and_fro, 0.0}});
  return {trees, corners, 10};
}

Work work_at_the_end_of(const std::string& type, double length, int rounds) {
  test::PathDrive drive = drive_to_and_fro(length, rounds);
  AssociatingFilter filter(named_filter(type, drive.setup()), drive.setup(), {});
  const auto warm_up = static_cast<int>(2.0 * (length + 5.0 * to_and_fro));
  Work before;
  Work work;
  for (int step = 0; !drive.at_end(); ++step) {
    drive.advance();
    const Scan scan = nameless(drive.scan());
    if (step == warm_up) before.blocks = filter.counts().blocks_touched;
    const long allocated = allocations();
    filter.motion_update(drive.odometry());
    filter.measurement_update(scan, ignore);
    if (step >= warm_up) work.allocations += allocations() - allocated;
  }
  work.blocks = filter.counts().blocks_touched - before.blocks;
  EXPECT_GT(static_cast<double>(filter.map().size()), 1.3 * length);
  EXPECT_LT(static_cast<double>(filter.map().size()), 1.4 * length + 15.0) << "landmarks twice in the map";
  return work;
}

TEST(AssociatingSeif, WorksTheSameInAMapOfAnySize) {
  const Work small = work_at_the_end_of("seif", 500.0, 10);
  const Work large = work_at_the_end_of("seif", test::under_sanitizer ? 1000.0 : 4000.0, 10);
  EXPECT_LT(static_cast<double>(large.blocks), 1.2 * static_cast<double>(small.blocks));
  // The tree's nodes may still come to be larger than they ever were: once in a hundred updates.
  EXPECT_LE(small.allocations, 20);
  EXPECT_LE(large.allocations, 20);
}

TEST(AssociatingFilter, AllocatesNothingOfItsOwn) {
  EXPECT_EQ(work_at_the_end_of("ekf", 2 * to_and_fro, 10).allocations, 0);
}

}  // namespace
}  // namespace seif
