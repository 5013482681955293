#include "seif/plain_seif.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "allocation_counter.hpp"
#include "dense_oracle.hpp"
#include "ring_drive.hpp"
#include "seif/dense/eif.hpp"
#include "seif/full_state.hpp"
#include "seif/registry.hpp"

namespace seif {
namespace {

using test::ignore;
using test::RingDrive;
using test::under_sanitizer;

TEST(PlainSeif, BoundsTheActiveLandmarksByThetaX) {
  RingDrive drive(60, 1);
  PlainSeif filter(drive.setup(), {.theta_x = 4, .random_landmarks = 5});
  for (int k = 0; k < 200; ++k) {
    drive.step(filter);
    EXPECT_LE(filter.counts().active_landmarks, 4);
  }
  EXPECT_EQ(filter.map().size(), 60U);
}

TEST(PlainSeif, EqualsTheDenseInformationFilterWithoutSparsificationAndWithExactMean) {
  RingDrive drive_sparse(40, 8);
  RingDrive drive_dense(40, 8);
  PlainSeif sparse(drive_sparse.setup(), {.theta_x = 1000, .mean_recovery = MeanRecovery::exact});
  Eif dense(drive_dense.setup());
  for (int k = 0; k < 150; ++k) {
    drive_sparse.step(sparse);
    drive_dense.step(dense);
  }
  EXPECT_LT((full_mu(sparse.state()) - dense.mu()).norm(), 1e-8);
  EXPECT_LT((oracle::symmetric(full_Omega(sparse.state())) - dense.Omega()).norm(),
            1e-8 * dense.Omega().norm());
  EXPECT_EQ(sparse.counts().links, dense.counts().links);
}

TEST(PlainSeif, GivesTheSameBitsForTheSameRandomStream) {
  RingDrive drive_a(60, 2);
  RingDrive drive_b(60, 2);
  PlainSeif a(drive_a.setup(), {});
  PlainSeif b(drive_b.setup(), {});
  for (int k = 0; k < 150; ++k) {
    drive_a.step(a);
    drive_b.step(b);
    ASSERT_EQ(a.pose().x, b.pose().x);
    ASSERT_EQ(a.pose().theta, b.pose().theta);
  }
}

/// Mean number of blocks touched by an update at the end of one round.
double blocks_touched(int landmarks) {
  RingDrive drive(landmarks, 3);
  PlainSeif filter(drive.setup(), {});
  const int measured = 100;
  for (int k = 0; k < drive.steps_for_a_round() - measured; ++k) drive.step(filter);
  const std::int64_t before = filter.counts().blocks_touched;
  for (int k = 0; k < measured; ++k) drive.step(filter);
  return static_cast<double>(filter.counts().blocks_touched - before) / measured;
}

TEST(PlainSeif, TouchesAsManyBlocksInALargeMapAsInASmallOne) {
  const double small = blocks_touched(300);
  const double large = blocks_touched(under_sanitizer ? 1'000 : 20'000);
  EXPECT_NEAR(large / small, 1.0, 0.1);
}

TEST(PlainSeif, DroppingTheWeakestLinkToTheLetterNeverLetsGoOfTheFirstLandmarks) {
  RingDrive drive(300, 3);
  PlainSeif filter(drive.setup(), {.drop = DropOrder::weakest_link});
  EXPECT_THROW(
      {
        for (int k = 0; k < 2 * drive.steps_for_a_round(); ++k) drive.step(filter);
      },
      NumericalFailure);
}

TEST(PlainSeif, AllocatesNothingOnceTheMapIsBuilt) {
  if (COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "the sanitizer has a malloc of its own";
  RingDrive drive(60, 4);
  PlainSeif filter(drive.setup(), {});
  for (int k = 0; k < 3 * drive.steps_for_a_round(); ++k) drive.step(filter);
  const long before = allocations();
  for (int k = 0; k < drive.steps_for_a_round(); ++k) drive.step(filter);
  EXPECT_EQ(allocations(), before);
}

TEST(PlainSeif, TakesEmptyScansAndAWorldWithoutLandmarks) {
  RingDrive drive(60, 5);
  PlainSeif filter(drive.setup(), {});
  filter.measurement_update({.t = 0.0, .observations = {}}, ignore);
  EXPECT_TRUE(filter.map().empty());
  EXPECT_EQ(filter.counts().links, 0);
}

TEST(Registry, RefusesASecondTypeOfTheSameName) {
  Registry registry = standard_estimators();
  EXPECT_NE(registry.find("seif_report"), nullptr);
  EXPECT_EQ(registry.find("no_such_filter"), nullptr);
  EXPECT_THROW(registry.add(*registry.find("ekf")), std::invalid_argument);
}

TEST(Registry, MakesEveryStandardEstimatorFromItsDefaults) {
  const RingDrive drive(60, 6);
  const Registry registry = standard_estimators();
  for (const EstimatorType& type : registry.types()) {
    Options options;
    for (const OptionSpec& spec : type.options) options[spec.key] = spec.fallback;
    EXPECT_EQ(type.make(drive.setup(), options)->map().size(), 0U) << type.name;
  }
}

}  // namespace
}  // namespace seif
