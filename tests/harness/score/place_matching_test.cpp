#include "harness/score/place_matching.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "harness/score/landmark_places.hpp"
#include "harness/score/map_counts.hpp"

namespace harness {
namespace {

using Ids = std::vector<seif::LandmarkId>;

constexpr seif::Pose2 T_est_true{30.0, -7.0, 2.0};  // how the maps of these tests lie

/// Landmarks 100, 101, .. scattered over a square, 2 m apart in the mean.
std::vector<TrueLandmark> scattered(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0.0, 2.0 * std::sqrt(count));
  std::vector<TrueLandmark> truth;
  for (int i = 0; i < count; ++i) {
    const double x = place(random);
    truth.push_back({100 + i, {x, place(random)}, 0.0});
  }
  return truth;
}

/// A map of every landmark, with names of its own, in another order.
std::vector<MapRecord> map_of(const std::vector<TrueLandmark>& truth, double sd) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> error(0.0, sd);
  std::vector<MapRecord> map;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector2d p = T_est_true * truth[truth.size() - 1 - i].position;
    const double x = p.x() + error(random);
    map.push_back({static_cast<seif::LandmarkId>(i),
                   {x, p.y() + error(random)},
                   Eigen::Matrix2d(sd * sd * Eigen::Matrix2d::Identity())});
  }
  return map;
}

/// The ids of map_of().
Ids ids_of(const std::vector<TrueLandmark>& truth) {
  Ids ids;
  for (std::size_t i = 0; i < truth.size(); ++i) ids.push_back(truth[truth.size() - 1 - i].landmark);
  return ids;
}

TEST(MatchByPlace, FindsAMapThatLiesAnywhere) {
  const std::vector<TrueLandmark> truth = scattered(60, 1);
  EXPECT_EQ(match_by_place(map_of(truth, 0.02), truth, std::nullopt), ids_of(truth));
}

TEST(MatchByPlace, FindsALargeMapToo) {
  const std::vector<TrueLandmark> truth = scattered(5000, 2);
  const std::vector<MapRecord> map = map_of(truth, 0.02);
  const auto ids = match_by_place(map, truth, std::nullopt);
  ASSERT_TRUE(ids);
  int right = 0;
  for (std::size_t i = 0; i < map.size(); ++i) right += (*ids)[i] == ids_of(truth)[0] - static_cast<int>(i);
  EXPECT_GT(right, 4950) << "of a few pairs both lie within the error";
}

TEST(MatchByPlace, BeginsAtAGuessAndMendsIt) {
  std::vector<TrueLandmark> truth = scattered(3, 1);  // too few to be searched for
  seif::Pose2 guess = inverse(T_est_true);
  guess.x += 0.2;
  guess.theta += 0.01;
  const std::vector<MapRecord> map = map_of(truth, 0.01);
  EXPECT_EQ(match_by_place(map, truth, guess), ids_of(truth));
  EXPECT_FALSE(match_by_place(map, truth, std::nullopt));
}

TEST(MatchByPlace, SearchesWhereTheGuessIsWrong) {
  const std::vector<TrueLandmark> truth = scattered(60, 1);
  EXPECT_EQ(match_by_place(map_of(truth, 0.02), truth, seif::Pose2{400.0, 0.0, 0.0}), ids_of(truth));
}

TEST(MatchByPlace, LeavesOutWhatIsSpuriousDuplicateOrMissed) {
  const std::vector<TrueLandmark> truth = scattered(60, 1);
  std::vector<MapRecord> map = map_of(truth, 0.02);
  Ids expected = ids_of(truth);
  map[3].mean = T_est_true * Eigen::Vector2d(-40.0, 8.0);  // its true landmark, 156, is missed then
  expected[3] = seif::no_landmark;
  MapRecord twice = map[7];
  twice.mean += Eigen::Vector2d(0.2, 0.0);
  map.push_back(twice);
  expected.push_back(seif::no_landmark);
  const auto ids = match_by_place(map, truth, std::nullopt);
  ASSERT_EQ(ids, expected);
  for (std::size_t i = 0; i < map.size(); ++i) map[i].landmark = (*ids)[i];
  const MapCounts counts = count_landmarks(map, truth, std::set<seif::LandmarkId>{156, 157, 158});
  EXPECT_EQ(counts.missed, 1);
  EXPECT_EQ(counts.spurious, 2);
  EXPECT_EQ(counts.duplicate, 1);
  EXPECT_FALSE(count_landmarks(map, truth, std::nullopt).missed) << "nobody knows what was seen";
}

TEST(MatchByPlace, GatesByTheCovariances) {
  const std::vector<TrueLandmark> truth = scattered(60, 1);
  std::vector<MapRecord> map = map_of(truth, 0.02);
  map[3].mean += Eigen::Vector2d(0.5, 0.0);
  EXPECT_EQ(match_by_place(map, truth, std::nullopt)->at(3), seif::no_landmark);
  map[3].covariance = 0.09 * Eigen::Matrix2d::Identity();
  EXPECT_EQ(match_by_place(map, truth, std::nullopt)->at(3), ids_of(truth)[3]);
}

TEST(MatchByPlace, SaysNothingOfAMapThatFitsNowhere) {
  EXPECT_FALSE(match_by_place(map_of(scattered(60, 1), 0.02), scattered(60, 2), std::nullopt));
  EXPECT_FALSE(match_by_place({}, scattered(60, 2), std::nullopt));
  EXPECT_FALSE(match_by_place(map_of(scattered(60, 1), 0.02), {}, seif::Pose2{}));
}

TEST(MatchByPlace, SaysNothingOfAMapThatFitsInManyPlaces) {
  std::vector<TrueLandmark> rows;
  for (int i = 0; i < 100; ++i) rows.push_back({i, {2.0 * (i % 10), 2.0 * (i / 10)}, 0.0});
  const std::vector<MapRecord> map = map_of(rows, 0.02);
  EXPECT_FALSE(match_by_place(map, rows, std::nullopt));
  EXPECT_EQ(match_by_place(map, rows, inverse(T_est_true)), ids_of(rows)) << "a guess makes it clear";
}

TEST(LandmarkPlaces, KnowTheSpacingInSpiteOfALandmarkFarAway) {
  const LandmarkPlaces places({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1e7, 0}});
  EXPECT_EQ(places.spacing(), 1.0);
  EXPECT_EQ(places.nearest({2.2, 0.0}, 0.5), 2U);
  EXPECT_FALSE(places.nearest({2.2, 0.0}, 0.1));
  EXPECT_FALSE(LandmarkPlaces({{1, 1}}).spacing());
}

}  // namespace
}  // namespace harness
