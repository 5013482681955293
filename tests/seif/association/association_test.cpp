// The parts of data association: gates, pairs, places.
#include "seif/association/association.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "seif/association/landmark_grid.hpp"
#include "seif/association/tentative_landmarks.hpp"

namespace seif {
namespace {

TEST(ChiSquareGate, IsThatOfTheTables) {
  EXPECT_NEAR(chi_square_gate(1, 0.05), 5.991, 1e-3);
  EXPECT_NEAR(chi_square_gate(1, 0.001), 13.816, 1e-3);
  EXPECT_NEAR(chi_square_gate(5, 0.001), 29.588, 1e-3);
  EXPECT_NEAR(chi_square_gate(20, 0.5), 39.335, 1e-3);
  EXPECT_NEAR(chi_square_gate(50, 0.01), 135.807, 1e-3);
}

/// Landmarks on a line, whose x and y the sensor measures, and a robot that knows its heading but not its
/// position on the line.
struct Line {
  explicit Line(std::vector<double> at, double pose_sd = 1.0) : places(std::move(at)) {
    const auto n = static_cast<Eigen::Index>(3 + 2 * places.size());
    Sigma = 1e-4 * Eigen::MatrixXd::Identity(n, n);
    Sigma(0, 0) = pose_sd * pose_sd;
  }

  /// An observation at x along the line: gives its pairs with all landmarks.
  void see(ScanMatcher& matcher, int observation, double x) const {
    for (std::size_t j = 0; j < places.size(); ++j) {
      ExpectedObservation expected;
      expected.v << x - places[j], 0.0;
      expected.J_x.leftCols<2>() = -Eigen::Matrix2d::Identity();
      expected.J_m.setIdentity();
      matcher.add(observation, static_cast<int>(j), expected, 1e-4 * Eigen::Matrix2d::Identity());
    }
  }

  std::vector<double> places;
  Eigen::MatrixXd Sigma;
};

TEST(ScanMatcher, JointPairsFitTogetherWhereTheNearestDoNot) {
  const Line line({0.0, 1.0, 2.5});
  const double shift = 0.7;  // the robot's error: the second landmark is nearest to the first observation
  for (const bool jointly : {false, true}) {
    ScanMatcher matcher(1e-3, 1e-6);
    matcher.begin(3, line.Sigma);
    for (int i = 0; i < 3; ++i) line.see(matcher, i, line.places[static_cast<std::size_t>(i)] + shift);
    jointly ? matcher.match_jointly() : matcher.match_nearest();
    EXPECT_EQ(matcher.match(0) == 0 && matcher.match(1) == 1 && matcher.match(2) == 2, jointly);
  }
}

TEST(ScanMatcher, EachLandmarkIsMatchedOnce) {
  const Line line({0.0, 5.0}, 0.01);
  for (const bool jointly : {false, true}) {
    ScanMatcher matcher(1e-3, 1e-6);
    matcher.begin(3, line.Sigma);
    line.see(matcher, 0, 0.01);
    line.see(matcher, 1, 0.002);
    line.see(matcher, 2, 5.0);
    jointly ? matcher.match_jointly() : matcher.match_nearest();
    EXPECT_EQ(matcher.match(2), 1);
    EXPECT_EQ((matcher.match(0) == 0) + (matcher.match(1) == 0), 1);
    EXPECT_TRUE(matcher.may_be_known(matcher.match(0) == 0 ? 1 : 0)) << "the same seen twice";
  }
}

TEST(ScanMatcher, BetweenTheGatesNothingIsSaid) {
  const Line line({0.0}, 0.01);  // S = 3e-4
  for (const double sigmas : {3.0, 4.5, 6.0}) {
    ScanMatcher matcher(1e-3, 1e-6);
    matcher.begin(1, line.Sigma);
    line.see(matcher, 0, sigmas * std::sqrt(3e-4));
    matcher.match_jointly();
    EXPECT_EQ(matcher.match(0) == 0, sigmas < 3.7);
    if (matcher.match(0) == ScanMatcher::none) {
      EXPECT_EQ(matcher.may_be_known(0), sigmas < 5.2);
    }
  }
}

// The pair of one observation tells where the other observations must be.
TEST(ScanMatcher, WhatFitsAloneMayBeKnownToBeNewFromTheOthers) {
  const Line line({0.0, 3.0});
  ScanMatcher matcher(1e-3, 1e-6);
  matcher.begin(2, line.Sigma);
  line.see(matcher, 0, 0.0);
  line.see(matcher, 1, 2.0);  // alone it would be within one sigma of the second landmark
  matcher.match_jointly();
  EXPECT_EQ(matcher.match(0) == ScanMatcher::none, matcher.match(1) != ScanMatcher::none);
  const int other = matcher.match(0) == ScanMatcher::none ? 0 : 1;
  EXPECT_FALSE(matcher.may_be_known(other));
}

/// Tries all hypotheses, one by one.
struct Exhaustive {
  using Pairs = std::vector<const Candidate*>;
  struct Best {
    std::size_t pairs = 0;
    double distance = 0.0;
    void take(const Pairs& other, double d) {
      if (other.size() < pairs || (other.size() == pairs && d >= distance)) return;
      pairs = other.size();
      distance = d;
    }
  };

  const std::vector<Candidate>& candidates;
  const Eigen::MatrixXd& Sigma;
  const Eigen::Matrix2d Q;
  int observations;
  Best best, of_which_all_parts_fit;

  double distance(const Pairs& pairs) const {
    if (pairs.empty()) return 0.0;
    const auto k = static_cast<Eigen::Index>(2 * pairs.size());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(k, Sigma.rows());
    Eigen::VectorXd v(k);
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(k, k);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(2 * i);
      J.block<2, 3>(row, 0) = pairs[i]->expected.J_x;
      J.block<2, 2>(row, 3 + 2 * pairs[i]->landmark) = pairs[i]->expected.J_m;
      v.segment<2>(row) = pairs[i]->expected.v;
      S.block<2, 2>(row, row) = Q;
    }
    S += J * Sigma * J.transpose();
    return v.dot(S.llt().solve(v));
  }

  bool fits(const Pairs& pairs) const {
    return pairs.empty() || distance(pairs) <= chi_square_gate(static_cast<int>(pairs.size()), 1e-3);
  }

  bool all_parts_fit(const Pairs& pairs) const {
    for (unsigned chosen = 0; chosen < 1U << pairs.size(); ++chosen) {
      Pairs part;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if ((chosen >> i & 1U) != 0) part.push_back(pairs[i]);
      }
      if (!fits(part)) return false;
    }
    return true;
  }

  void look(int observation, Pairs& pairs) {
    if (observation == observations) {
      if (fits(pairs)) best.take(pairs, distance(pairs));
      if (all_parts_fit(pairs)) of_which_all_parts_fit.take(pairs, distance(pairs));
      return;
    }
    for (const Candidate& c : candidates) {
      if (c.observation != observation) continue;
      if (std::ranges::find(pairs, c.landmark, &Candidate::landmark) != pairs.end()) continue;
      pairs.push_back(&c);
      look(observation + 1, pairs);
      pairs.pop_back();
    }
    look(observation + 1, pairs);
  }
};

// A hypothesis may fit as a whole although a part of it does not. Whether a search finds it depends on the
// order in which pairs are tried.
TEST(ScanMatcher, JointPairsAreThoseOfAnExhaustiveSearch) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int left_out = 0;
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    constexpr int landmarks = 5;
    constexpr int observations = 4;
    const Eigen::MatrixXd A =
        Eigen::MatrixXd::NullaryExpr(3 + 2 * landmarks, 6, [&] { return 0.4 * normal(random); });
    const Eigen::MatrixXd Sigma =
        A * A.transpose() + 0.01 * Eigen::MatrixXd::Identity(3 + 2 * landmarks, 3 + 2 * landmarks);
    const Eigen::Matrix2d Q = 0.05 * Eigen::Matrix2d::Identity();
    ScanMatcher matcher(1e-3, 1e-6, 1'000'000);
    matcher.begin(observations, Sigma);
    for (int i = 0; i < observations; ++i) {
      for (int j = 0; j < landmarks; ++j) {
        ExpectedObservation e;
        e.v << 4.0 * normal(random), 4.0 * normal(random);
        e.J_x = Matrix23::NullaryExpr([&] { return normal(random); });
        e.J_m = Eigen::Matrix2d::NullaryExpr([&] { return normal(random); });
        matcher.add(i, j, e, Q);
      }
    }
    const std::vector<Candidate> candidates(matcher.candidates().begin(), matcher.candidates().end());
    Exhaustive oracle{candidates, Sigma, Q, observations, {}, {}};
    Exhaustive::Pairs pairs;
    oracle.look(0, pairs);
    matcher.match_jointly();
    for (int i = 0; i < observations; ++i) {
      for (const Candidate& c : candidates) {
        if (c.observation == i && c.landmark == matcher.match(i)) pairs.push_back(&c);
      }
    }
    ASSERT_TRUE(oracle.fits(pairs));
    ASSERT_LE(pairs.size(), oracle.best.pairs);
    ASSERT_GE(pairs.size(), oracle.of_which_all_parts_fit.pairs);
    left_out += observations - static_cast<int>(pairs.size());
    if (oracle.best.distance != oracle.of_which_all_parts_fit.distance) continue;
    ASSERT_EQ(pairs.size(), oracle.best.pairs);
    ASSERT_NEAR(oracle.distance(pairs), oracle.best.distance, 1e-8);
    ++compared;
  }
  EXPECT_GT(compared, 150);
  EXPECT_GT(left_out, 20) << "otherwise the search was too easy";
}

TEST(LandmarkGrid, FindsTheNearestAsALookAtAllDoes) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-30.0, 30.0);
  const auto draw = [&] { return Eigen::Vector2d(uniform(random), uniform(random)); };
  LandmarkGrid grid(1.5);
  std::vector<Eigen::Vector2d> places;
  std::vector<bool> is_in;
  for (int i = 0; i < 2000; ++i) {
    places.push_back(draw());
    is_in.push_back(true);
    grid.add(places.back());
    if (i % 3 == 0) grid.move(i / 2, places[static_cast<std::size_t>(i / 2)] = draw());
    if (i % 7 == 0) {
      grid.remove(i / 3);
      is_in[static_cast<std::size_t>(i / 3)] = false;
    }
    if (i % 20 != 0) continue;
    const Eigen::Vector2d p = draw();
    const double radius = 0.2 * std::abs(uniform(random));
    std::vector<LandmarkGrid::Near> near;
    grid.find_near(p, radius, 8, near);
    std::vector<double> distances;
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (is_in[j] && (places[j] - p).norm() <= radius) distances.push_back((places[j] - p).norm());
    }
    std::ranges::sort(distances);
    ASSERT_EQ(near.size(), std::min<std::size_t>(8, distances.size()));
    for (std::size_t k = 0; k < near.size(); ++k) {
      ASSERT_EQ(near[k].distance, distances[k]);
      ASSERT_TRUE(is_in[static_cast<std::size_t>(near[k].landmark)]);
    }
  }
}

TEST(TentativeLandmarks, CountsScansThatSawAPlaceAndForgetsIt) {
  TentativeLandmarks tentative(3);
  for (int scan = 0; scan < 4; ++scan) {
    tentative.begin_scan(0.0);
    EXPECT_EQ(tentative.see({1.0, 0.01 * scan}, 0.01, 9.0).times, scan + 1);
    EXPECT_EQ(tentative.see({5.0, 0.0}, 0.01, 9.0).times, scan + 1);
  }
  tentative.admit_last();
  EXPECT_EQ(tentative.size(), 1U);
  for (int scan = 0; scan < 3; ++scan) tentative.begin_scan(0.0);
  EXPECT_EQ(tentative.see({1.0, 0.0}, 0.01, 9.0).times, 5) << "two scans have missed it";
  for (int scan = 0; scan < 4; ++scan) tentative.begin_scan(0.0);
  EXPECT_EQ(tentative.size(), 0U);
}

TEST(TentativeLandmarks, TwoSightingsOfOneScanAreTwo) {
  TentativeLandmarks tentative(3);
  tentative.begin_scan(0.0);
  EXPECT_EQ(tentative.see({1.0, 0.0}, 0.01, 9.0).times, 1);
  EXPECT_EQ(tentative.see({1.01, 0.0}, 0.01, 9.0).times, 1);
  EXPECT_EQ(tentative.size(), 2U);
}

TEST(TentativeLandmarks, AreNoMoreThanTheyMayBe) {
  TentativeLandmarks tentative(10);
  tentative.begin_scan(0.0);
  for (int i = 0; i < 1000; ++i) tentative.see({10.0 * i, 0.0}, 0.01, 9.0);
  EXPECT_LE(tentative.size(), 128U);
}

}  // namespace
}  // namespace seif
