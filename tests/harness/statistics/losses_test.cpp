#include "harness/statistics/losses.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace harness {
namespace {

constexpr double right = 1.0;     // [-] e' P^-1 e
constexpr double wrong = 1000.0;  // [-]

UpdateOfLoss fits(double t) { return {.t = t, .has_used = true, .left_out = 1}; }
UpdateOfLoss shut_out(double t) { return {.t = t, .left_out = 4}; }
UpdateOfLoss sees_nothing(double t) { return {.t = t}; }
UpdateOfLoss found(double t, double distance) {
  return {.t = t, .left_out = 4, .relocations = 1, .distance = distance};
}

TEST(Losses, OneScanThatDoesNotFitIsNone) {
  Losses losses;
  for (const UpdateOfLoss& update :
       {fits(0.0), shut_out(1.0), fits(2.0), shut_out(3.0), sees_nothing(4.0), fits(5.0)})
    losses.add(update);
  EXPECT_EQ(losses.count(), 0);
  EXPECT_EQ(losses.lost_s(), 0.0);
  EXPECT_FALSE(losses.first_found_t());
}

TEST(Losses, LastFromTheFirstScanThatIsLeftOutUntilItIsFound) {
  Losses losses;
  losses.add(fits(0.0));
  losses.add(shut_out(1.0));
  EXPECT_FALSE(losses.is_lost());
  losses.add(shut_out(2.0));
  EXPECT_TRUE(losses.is_lost());
  losses.add(sees_nothing(3.0));
  losses.add(found(4.0, right));
  EXPECT_FALSE(losses.is_lost());
  losses.add(fits(5.0));
  EXPECT_EQ(losses.count(), 1);
  EXPECT_EQ(losses.found(), 1);
  EXPECT_EQ(losses.found_wrongly(), 0);
  EXPECT_DOUBLE_EQ(losses.lost_s(), 3.0);
  EXPECT_EQ(losses.first_found_t(), 4.0);
}

TEST(Losses, ThatEndByThemselvesAreNotFound) {
  Losses losses;
  for (const UpdateOfLoss& update : {shut_out(1.0), shut_out(2.0), shut_out(3.0), fits(4.0), fits(5.0)})
    losses.add(update);
  EXPECT_EQ(losses.count(), 1);
  EXPECT_EQ(losses.found(), 0);
  EXPECT_DOUBLE_EQ(losses.lost_s(), 3.0);
}

TEST(Losses, TellWhatIsFoundWrongly) {
  Losses losses;
  for (const UpdateOfLoss& update :
       {shut_out(1.0), found(2.0, wrong), shut_out(3.0), shut_out(4.0), found(5.0, right)})
    losses.add(update);
  EXPECT_EQ(losses.count(), 2);
  EXPECT_EQ(losses.found(), 2);
  EXPECT_EQ(losses.found_wrongly(), 1);
  EXPECT_EQ(losses.first_found_t(), 2.0);
  EXPECT_EQ(losses.found_t(), 5.0);
}

TEST(Losses, RelocationsOfAFilterThatIsNotLostAreNone) {
  Losses losses;
  for (int i = 0; i < 5; ++i) losses.add({.t = 1.0 * i, .has_used = true, .relocations = 1});
  EXPECT_EQ(losses.count(), 0);
  EXPECT_EQ(losses.found(), 0);
}

TEST(SquaredDistance, IsThatOfMahalanobisAndNothingWithoutACovariance) {
  const Eigen::Vector3d error(2.0, -1.0, 0.5);
  Eigen::Matrix3d P;
  P << 2.0, 0.3, 0.1, 0.3, 1.0, -0.2, 0.1, -0.2, 0.5;
  EXPECT_NEAR(*squared_distance(error, P), error.dot(P.inverse() * error), 1e-12);
  EXPECT_FALSE(squared_distance(error, -P));
}

}  // namespace
}  // namespace harness
