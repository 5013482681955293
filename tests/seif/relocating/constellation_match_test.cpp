// The promised probability of a wrong match, against counted ones.
#include "seif/relocating/constellation_match.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "seif/relocating/scattered.hpp"
#include "seif/ring_drive.hpp"

namespace seif {
namespace {

constexpr double map_sd = 0.02;  // [m] of a landmark

using test::Points;
using test::reach;
using test::scattered;
using test::sighting_sd;

/// A belief over a map of independent landmarks.
class KnownMap final : public LocalBelief {
 public:
  explicit KnownMap(const Points& landmarks) : landmarks_(landmarks) {}

  void begin_association(double /*t*/) override {}
  void landmarks_at_hand(std::vector<LandmarkId>& /*out*/) const override {}
  bool is_at_hand(LandmarkId /*landmark*/) const override { return true; }
  Eigen::Vector2d mean_of(LandmarkId landmark) const override {
    return landmarks_[static_cast<std::size_t>(landmark)];
  }
  ExpectedObservation expect(LandmarkId /*landmark*/, const Observation& /*observation*/) const override {
    return {};
  }
  void covariance_with(std::span<const LandmarkId> /*landmarks*/,
                       Eigen::Ref<Eigen::MatrixXd> out) const override {
    out.setIdentity();
    out *= map_sd * map_sd;
  }
  void equate(LandmarkId /*a*/, LandmarkId /*b*/) override {}
  void relocate(const Relocation& /*relocation*/) override {}

 private:
  const Points& landmarks_;
};

/// What a robot sees around it, at most twelve landmarks, each known by itself.
Surroundings seen_from(const Points& landmarks, const Pose2& T_world_robot, std::mt19937_64& random) {
  const Points points = test::around(landmarks, T_world_robot, sighting_sd, 12, random);
  const auto n = static_cast<Eigen::Index>(2 * points.size());
  Surroundings seen{.landmarks = {},
                    .p_robot = Eigen::VectorXd(n),
                    .covariance = sighting_sd * sighting_sd * Eigen::MatrixXd::Identity(n, n)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    seen.p_robot.segment<2>(2 * static_cast<Eigen::Index>(i)) = points[i];
    seen.landmarks.push_back(static_cast<LandmarkId>(i));
  }
  return seen;
}

struct Match {
  double log_chance = std::numeric_limits<double>::infinity();  // [nat]
  Pose2 T_world_robot;
};

/// What the filter would find for a robot that it believes elsewhere.
Match match(const Points& landmarks, const Surroundings& seen) {
  LandmarkGrid grid{1.5};
  SettledConstellations map(grid);
  for (int i = 0; i < 100; ++i) map.widen(reach, sighting_sd);
  for (const Eigen::Vector2d& p : landmarks) {
    grid.add(p);
    map.note_joined(static_cast<LandmarkId>(grid.size()) - 1, 0);
  }
  map.settle_all();
  ConstellationSearch search(grid, map.index(), map.near());
  ConstellationSearch::Points points;
  for (std::size_t i = 0; i < seen.size(); ++i) points.p_local.push_back(seen.at(i));
  constexpr double far = 1000.0;  // [m]
  search.set_points(points, {}, {far, far, 1.0});
  search.look_around();
  const std::optional<ConstellationSearch::Found> found = search.best();
  KnownMap belief(landmarks);
  Placement placement;
  if (!found || !place(belief, seen, *found, {}, placement)) return {};
  return {log_chance(seen.size(), *found, placement), placement.T_world_robot};
}

constexpr int maps = test::under_sanitizer ? 1'000 : 10'000;
constexpr int landmarks_of_map = 60;
constexpr double width = 20.0;  // [m]

// The robot stands in another world each time, so whatever is found is wrong.
TEST(ChanceOfAMatch, IsNotLessThanHowOftenMatchesAreWrong) {
  std::mt19937_64 random(5);
  std::vector<double> chances;
  for (int i = 0; i < maps; ++i) {
    const Points landmarks = scattered(landmarks_of_map, width, random);
    const Surroundings elsewhere =
        seen_from(scattered(landmarks_of_map, width, random), {10.0, 10.0, 0.5}, random);
    if (elsewhere.size() < 3) continue;
    chances.push_back(match(landmarks, elsewhere).log_chance);
  }
  ASSERT_GT(chances.size(), maps * 9 / 10);
  for (const double promised : {1e-6, 1e-4, 1e-3, 1e-2, 0.1}) {
    const auto wrong = std::ranges::count_if(chances, [&](double c) { return c <= std::log(promised); });
    EXPECT_LE(static_cast<double>(wrong), promised * maps) << "promised " << promised;
  }
}

// The bound would be worth nothing if right matches did not pass it.
TEST(ChanceOfAMatch, IsSmallForMostThatAreRight) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> place(4.0, width - 4.0);
  std::uniform_real_distribution<double> turn(-std::numbers::pi, std::numbers::pi);
  constexpr int tries = 300;
  int passed = 0;
  for (int i = 0; i < tries; ++i) {
    const Points landmarks = scattered(landmarks_of_map, width, random);
    const Pose2 there{place(random), place(random), turn(random)};
    const Match found = match(landmarks, seen_from(landmarks, there, random));
    if (found.log_chance > std::log(1e-6)) continue;
    ++passed;
    EXPECT_NEAR(found.T_world_robot.x, there.x, 0.3);
    EXPECT_NEAR(found.T_world_robot.y, there.y, 0.3);
  }
  EXPECT_GE(passed, tries * 9 / 10);
}

}  // namespace
}  // namespace seif
