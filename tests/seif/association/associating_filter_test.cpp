// Drives whose observations name no landmark: the associations that ekf and seif find.
#include "seif/association/associating_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "allocation_counter.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/dense_oracle.hpp"
#include "seif/path_drive.hpp"
#include "seif/ring_drive.hpp"
#include "seif/seif.hpp"
#include "seif/start_points.hpp"

namespace seif {
namespace {

using test::ignore;
using test::RingDrive;

std::unique_ptr<Estimator> named_filter(const std::string& type, const EstimatorSetup& setup,
                                        const SeifOptions& options = {}) {
  if (type == "ekf") return std::make_unique<Ekf>(setup);
  return std::make_unique<Seif>(setup, options);
}

Scan nameless(Scan scan) {
  for (Observation& observation : scan.observations) observation.landmark = no_landmark;
  return scan;
}

/// The result of a drive, counted with the true names.
struct Outcome {
  int named = 0, left_out = 0, wrong = 0;
  std::map<LandmarkId, LandmarkId> true_of;  // by the filter's name: true name of its first observation

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

// Without the noise of the linearisation, which grows with the uncertainty of the heading.
// Another start moves the map together with the pose, and changes no relative certainty. This holds until a
// ring closes: from then on levers are those of the means.
TEST(AssociatingSeif, GivesTheSameNamesWhereverTheStartMayBe) {
  RingDrive drive(400, 1);
  EstimatorSetup uncertain = drive.setup();
  uncertain.start.covariance *= 1e3;
  std::vector<std::unique_ptr<AssociatingFilter>> filters;
  for (const EstimatorSetup& setup : {drive.setup(), uncertain})
    filters.push_back(
        std::make_unique<AssociatingFilter>(named_filter("seif", setup, {.linearisation_noise = 0.0}), setup,
                                            AssociationOptions{.jointly = true}));
  for (int step = 0; step < drive.steps_for_a_round() - 20; ++step) {
    drive.advance();
    for (const auto& filter : filters) {
      filter->motion_update(drive.odometry());
      filter->measurement_update(nameless(drive.scan()), ignore);
    }
    ASSERT_TRUE(std::ranges::equal(filters[0]->associations(), filters[1]->associations()))
        << "step " << step;
  }
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

// The gates are so narrow that known landmarks are often taken for new ones.
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

// The covariance of the window, with the information of hub and messages, and that of the other landmarks of
// the zone. The reference is the inverse of all of Omega.
TEST(SeifCovariance, IsThatOfTheWholeInformationMatrix) {
  RingDrive drive(120, 5);
  SeifOptions options;
  options.tree.most_unknowns = 1'000'000;  // no groups, since groups are an approximation
  options.tree.turns = false;              // all of Omega is one matrix then
  Seif filter(drive.setup(), options);
  LocalBelief& belief = *filter.local_belief();
  int passive = 0;
  for (int step = 0; step < drive.steps_for_a_round() + 60; ++step) {
    drive.step(filter);
    if (step % 10 != 0) continue;
    belief.begin_association(0.0);
    std::vector<LandmarkId> ids;
    belief.landmarks_at_hand(ids);
    const auto n = static_cast<Eigen::Index>(3 + 2 * ids.size());
    Eigen::MatrixXd P(n, n);
    belief.covariance_with(ids, P);
    const Eigen::MatrixXd all = filter.whole_belief_matrix().inverse();
    Eigen::VectorXi rows(n);
    rows.head<3>() << 0, 1, 2;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const int slot = filter.state().find(ids[i]).value();
      const int row = 3 + 2 * (slot - static_cast<int>(start_points.size()));
      const auto at = static_cast<Eigen::Index>(3 + 2 * i);
      rows.segment<2>(at) << row, row + 1;
      passive += filter.state().position(slot) < 0;
    }
    ASSERT_LT((P - all(rows, rows)).norm(), 1e-7 * all(rows, rows).norm()) << step;
  }
  EXPECT_GT(passive, 100) << "otherwise only the window was tested";
}

/// Adds m_a = m_b; the reference conditions the joint Gaussian.
class Equate : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Filters, Equate, testing::Values("ekf", "seif"),
                         [](const auto& filter) { return filter.param; });

TEST_P(Equate, ConditionsTheBelief) {
  RingDrive drive(40, 6);
  SeifOptions options;
  options.first_estimates = 0;  // no null space to keep
  options.tree.most_unknowns = 1'000'000;
  options.tree.turns = false;
  EstimatorSetup setup = drive.setup();
  setup.start.covariance = 1e-12 * Eigen::Matrix3d::Identity();  // seif never learns anything about its start
  const auto filter = named_filter(GetParam(), setup, options);
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

  filter->local_belief()->equate(ids[0], ids[1]);
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

// Like the rest of seif: the same work in a map of any size, and no allocation.

/// Counts the filter's own allocations during motions and scans, since its tree may still grow.
class Metered final : public Estimator, public LocalBelief {
 public:
  Metered(const EstimatorSetup& setup, long& allocated)
      : seif_(setup, {}), belief_(*seif_.local_belief()), allocated_(allocated) {}

  LocalBelief* local_belief() override { return this; }

  void motion_update(const Odometry& odometry) override {
    meter([&] { seif_.motion_update(odometry); });
  }
  void measurement_update(const Scan& scan, const StageDone& done) override {
    meter([&] { seif_.measurement_update(scan, done); });
  }
  void begin_association(double t) override {
    meter([&] { belief_.begin_association(t); });
  }
  void landmarks_at_hand(std::vector<LandmarkId>& out) const override { belief_.landmarks_at_hand(out); }
  bool is_at_hand(LandmarkId landmark) const override { return belief_.is_at_hand(landmark); }
  Eigen::Vector2d mean_of(LandmarkId landmark) const override {
    Eigen::Vector2d mean;
    meter([&] { mean = belief_.mean_of(landmark); });
    return mean;
  }
  ExpectedObservation expect(LandmarkId landmark, const Observation& observation) const override {
    return belief_.expect(landmark, observation);
  }
  void covariance_with(std::span<const LandmarkId> landmarks,
                       Eigen::Ref<Eigen::MatrixXd> out) const override {
    belief_.covariance_with(landmarks, out);
  }
  void want(std::span<const LandmarkId> landmarks) override { belief_.want(landmarks); }
  void equate(LandmarkId a, LandmarkId b) override { belief_.equate(a, b); }
  bool bring(std::span<const LandmarkId> landmarks) override { return belief_.bring(landmarks); }
  void relocate(const Relocation& relocation) override { belief_.relocate(relocation); }
  Pose2 pose() const override { return seif_.pose(); }
  Counts counts() const override { return seif_.counts(); }
  std::size_t memory_bytes() const override { return seif_.memory_bytes(); }
  std::vector<LandmarkEstimate> map() const override { return seif_.map(); }
  std::optional<MarginalCovariances> marginal_covariances(std::span<const LandmarkId> ids) const override {
    return seif_.marginal_covariances(ids);
  }

 private:
  template <class Step>
  void meter(const Step& step) const {
    const long before = allocations();
    step();
    allocated_ += allocations() - before;
  }
  Seif seif_;
  LocalBelief& belief_;
  long& allocated_;
};

constexpr double to_and_fro = 60.0;  // [m]

/// Two uneven rows of trees. The robot drives out along them, and then to and fro along the last part.
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

struct Work {
  std::int64_t blocks = 0;         // the median of an update
  long allocations = 0;            // without those of the filter
  long allocations_of_filter = 0;  // of the filter, which gets the names
};

Work work_at_the_end_of(double length) {
  test::PathDrive drive = drive_to_and_fro(length, 10);
  Work before;
  Work work;
  std::vector<std::int64_t> blocks;  // of each update
  blocks.reserve(10'000);
  const auto make_local = [](const EstimatorSetup& setup) {
    return std::make_unique<AssociatingFilter>(named_filter("seif", setup), setup, AssociationOptions{});
  };
  AssociatingFilter filter(std::make_unique<Metered>(drive.setup(), work.allocations_of_filter),
                           drive.setup(), {}, make_local);  // it looks for its place, if it is lost
  const auto warm_up = static_cast<int>(2.0 * (length + 5.0 * to_and_fro));
  for (int step = 0; !drive.at_end(); ++step) {
    drive.advance();
    const Scan scan = nameless(drive.scan());
    if (step == warm_up) before = {0, 0, work.allocations_of_filter};
    const std::int64_t touched = filter.counts().blocks_touched;
    const long allocated = allocations();
    filter.motion_update(drive.odometry());
    filter.measurement_update(scan, ignore);
    if (step < warm_up) continue;
    work.allocations += allocations() - allocated;
    blocks.push_back(filter.counts().blocks_touched - touched);
  }
  const auto middle = blocks.begin() + static_cast<std::ptrdiff_t>(blocks.size() / 2);
  std::ranges::nth_element(blocks, middle);
  work.blocks = *middle;
  work.allocations -= work.allocations_of_filter - before.allocations_of_filter;
  EXPECT_GT(static_cast<double>(filter.map().size()), 1.3 * length);
  EXPECT_LT(static_cast<double>(filter.map().size()), 1.4 * length + 15.0) << "landmarks twice in the map";
  return work;
}

// The median, since the cost of moving the tree's zone depends on where the borders of leaves are.
TEST(AssociatingSeif, WorksTheSameInAMapOfAnySizeAndAllocatesNothingOfItsOwn) {
  const Work small = work_at_the_end_of(500.0);
  const Work large = work_at_the_end_of(test::under_sanitizer ? 1000.0 : 4000.0);
  EXPECT_LE(static_cast<double>(large.blocks) / static_cast<double>(small.blocks), 1.1);
  EXPECT_EQ(small.allocations, 0);
  EXPECT_EQ(large.allocations, 0);
}

}  // namespace
}  // namespace seif
