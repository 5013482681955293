#include "harness/score/place_matching.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "harness/score/landmark_places.hpp"
#include "harness/score/score.hpp"
#include "harness/statistics/alignment.hpp"

namespace harness {

namespace {

using Eigen::Vector2d;
using Index = std::size_t;

constexpr double lone_spacing = 1.0;         // [m] of a world with one landmark
constexpr double floor_sd = 0.1;             // [m] added to the covariances of a map
constexpr double gate = 13.8;                // [-] quantile of the chi-square distribution, 2 degrees, 99.9 %
constexpr double median_chi_square = 1.386;  // [-] with 2 degrees of freedom
constexpr double near_share = 0.25;          // [-] of the spacing: so near is hardly by chance
constexpr Index most_rounds = 20;            // [-] of an alignment
constexpr Index least_for_search = 5;        // [-] landmarks; fewer lie anywhere by chance
constexpr Index neighbourhood = 17;          // [-] landmarks, the first one included
constexpr Index far_end = 6;                 // [-] place among these of the second landmark of a pair
constexpr Index true_neighbours = 25;        // [-] landmarks, the first one included
constexpr Index most_places = 8;             // [-] of a neighbourhood in the world; more are ambiguous
constexpr Index most_ambiguous = 3;          // [-] neighbourhoods, until the search ends
constexpr double everywhere = std::numeric_limits<double>::infinity();

/// A landmark of the map and one of the world, by their indices.
struct IndexPair {
  double distance = 0.0;  // [m], or [sigma^2] where it says so
  Index est = 0;
  Index truth = 0;
};

struct Match {
  std::vector<IndexPair> pairs;
  double median_distance = 0.0;  // [m]
};

/// A pair of the world's landmarks.
struct TruePair {
  double length = 0.0;  // [m]
  Index from = 0;
  Index to = 0;
};

/// A position of the map in the world.
struct Hypothesis {
  Index score = 0;     // [-] landmarks of the neighbourhood that fit
  double error = 0.0;  // [m^2] sum of their squared distances
  seif::Pose2 T_true_est;
};

/// Keeps each landmark at most once, the best pairs first. Of equally good pairs the first indices count.
std::vector<IndexPair> one_to_one(std::vector<IndexPair> candidates, Index est_count, Index true_count) {
  std::ranges::sort(candidates, {},
                    [](const IndexPair& pair) { return std::tuple(pair.distance, pair.est, pair.truth); });
  std::vector<bool> est_taken(est_count);
  std::vector<bool> true_taken(true_count);
  std::erase_if(candidates, [&](const IndexPair& pair) {
    if (est_taken[pair.est] || true_taken[pair.truth]) return true;
    est_taken[pair.est] = true_taken[pair.truth] = true;
    return false;
  });
  return candidates;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The motion that takes the segment of `p` to that of `q`, middle to middle.
seif::Pose2 motion_between(const Vector2d& p_begin, const Vector2d& p_end, const Vector2d& q_begin,
                           const Vector2d& q_end) {
  const Vector2d p = p_end - p_begin;
  const Vector2d q = q_end - q_begin;
  const seif::Pose2 turn{0.0, 0.0, std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q))};
  const Vector2d offset = 0.5 * (q_begin + q_end) - turn * Vector2d(0.5 * (p_begin + p_end));
  return {offset.x(), offset.y(), turn.theta};
}

std::vector<Vector2d> means_of(std::span<const MapRecord> map) {
  std::vector<Vector2d> points;
  for (const MapRecord& landmark : map) points.push_back(landmark.mean);
  return points;
}

std::vector<Vector2d> positions_of(std::span<const TrueLandmark> truth) {
  std::vector<Vector2d> points;
  for (const TrueLandmark& landmark : truth) points.push_back(landmark.position);
  return points;
}

class PlaceMatcher {
 public:
  PlaceMatcher(std::span<const MapRecord> map, std::span<const TrueLandmark> truth)
      : map_(map),
        est_(means_of(map)),
        true_(positions_of(truth)),
        spacing_(true_.spacing().value_or(lone_spacing)) {
    all_.resize(map.size());
    std::iota(all_.begin(), all_.end(), Index{0});
  }

  /// From a guess; empty if the map does not fit there.
  std::optional<Match> match_at(const seif::Pose2& T_true_est) const;
  std::optional<Match> search() const;

 private:
  const Vector2d& est(Index i) const { return est_.points()[i]; }
  const Vector2d& truth(Index i) const { return true_.points()[i]; }

  std::vector<IndexPair> nearest_pairs(const seif::Pose2& T_true_est, std::span<const Index> of) const;
  seif::Pose2 refined(seif::Pose2 T_true_est, std::span<const Index> of) const;
  Match match(const seif::Pose2& T_true_est) const;
  Eigen::Matrix2d covariance_of(Index i, const seif::Pose2& T_true_est) const;
  bool fits(const Match& match) const;

  std::vector<TruePair> true_pairs() const;
  std::vector<Hypothesis> hypotheses(std::span<const Index> around, std::span<const TruePair> pairs) const;
  void rate(Hypothesis& hypothesis, std::span<const Index> around) const;
  std::vector<Hypothesis> distinct(std::vector<Hypothesis> all, const Vector2d& p_est) const;
  std::optional<Match> best_of(std::span<const Hypothesis> places, std::span<const Index> outwards) const;

  std::span<const MapRecord> map_;
  LandmarkPlaces est_;
  LandmarkPlaces true_;
  double spacing_;  // [m] of the world's landmarks
  std::vector<Index> all_;
};

/// One to one, within the spacing of the world's landmarks.
std::vector<IndexPair> PlaceMatcher::nearest_pairs(const seif::Pose2& T_true_est,
                                                   std::span<const Index> of) const {
  std::vector<IndexPair> candidates;
  for (const Index i : of) {
    const auto& found = true_.near(T_true_est * est(i), spacing_, 1);
    if (!found.empty()) candidates.push_back({found.front().distance, i, found.front().index});
  }
  return one_to_one(std::move(candidates), map_.size(), true_.points().size());
}

/// Aligns nearest pairs, and pairs anew, until nothing changes. Pairs much farther apart than most do not
/// count.
seif::Pose2 PlaceMatcher::refined(seif::Pose2 T_true_est, std::span<const Index> of) const {
  constexpr double far = 2.5;  // [-] of the median
  std::vector<std::pair<Index, Index>> before;
  for (Index round = 0; round < most_rounds; ++round) {
    const std::vector<IndexPair> pairs = nearest_pairs(T_true_est, of);
    if (pairs.empty()) break;
    const double limit = far * pairs[pairs.size() / 2].distance;
    std::vector<std::pair<Index, Index>> now;
    std::vector<Vector2d> from;
    std::vector<Vector2d> to;
    for (const IndexPair& pair : pairs) {
      if (pair.distance > limit) break;
      now.emplace_back(pair.est, pair.truth);
      from.push_back(est(pair.est));
      to.push_back(truth(pair.truth));
    }
    std::ranges::sort(now);
    if (now == before) break;
    const std::optional<seif::Pose2> next = align(from, to);
    if (!next) break;
    T_true_est = *next;
    before = std::move(now);
  }
  return T_true_est;
}

/// The covariance of a landmark, in the frame of the world; the identity if there is none.
Eigen::Matrix2d PlaceMatcher::covariance_of(Index i, const seif::Pose2& T_true_est) const {
  const std::optional<Eigen::Matrix2d>& covariance = map_[i].covariance;
  if (!covariance || Eigen::LLT<Eigen::Matrix2d>(*covariance).info() != Eigen::Success)
    return Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_true_est.theta).toRotationMatrix();
  return R * *covariance * R.transpose();
}

/// The covariances are scaled to the errors of the map: what the start leaves uncertain is in them, and is
/// aligned away; and a filter may be too sure of itself.
Match PlaceMatcher::match(const seif::Pose2& T_true_est) const {
  std::vector<double> ratios;
  for (const IndexPair& pair : nearest_pairs(T_true_est, all_)) {
    const Vector2d error = T_true_est * est(pair.est) - truth(pair.truth);
    ratios.push_back(error.dot(covariance_of(pair.est, T_true_est).llt().solve(error)));
  }
  if (ratios.empty()) return {};
  const double scale = median(std::move(ratios)) / median_chi_square;
  const double floor = std::min(floor_sd, near_share * spacing_);
  std::vector<IndexPair> candidates;
  for (const Index i : all_) {
    const Eigen::Matrix2d C =
        scale * covariance_of(i, T_true_est) + floor * floor * Eigen::Matrix2d::Identity();
    const Vector2d p = T_true_est * est(i);
    constexpr Index most = 4;
    for (const LandmarkPlaces::Near& found : true_.near(p, spacing_, most)) {
      const Index j = found.index;
      const Vector2d error = p - truth(j);
      if (const double squared = error.dot(C.llt().solve(error)); squared <= gate)
        candidates.push_back({squared, i, j});
    }
  }
  Match match{.pairs = one_to_one(std::move(candidates), map_.size(), true_.points().size())};
  std::vector<double> distances;
  for (const IndexPair& pair : match.pairs)
    distances.push_back((T_true_est * est(pair.est) - truth(pair.truth)).norm());
  if (!distances.empty()) match.median_distance = median(std::move(distances));
  return match;
}

bool PlaceMatcher::fits(const Match& match) const {
  return !match.pairs.empty() && 2 * match.pairs.size() >= map_.size() &&
         match.median_distance <= near_share * spacing_;
}

std::optional<Match> PlaceMatcher::match_at(const seif::Pose2& T_true_est) const {
  Match found = match(refined(T_true_est, all_));
  return fits(found) ? std::optional(std::move(found)) : std::nullopt;
}

/// Each of the world's landmarks with those around it, the shortest pairs first.
std::vector<TruePair> PlaceMatcher::true_pairs() const {
  std::vector<TruePair> pairs;
  for (Index i = 0; i < true_.points().size(); ++i) {
    for (const LandmarkPlaces::Near& found : true_.near(truth(i), everywhere, true_neighbours)) {
      const Index j = found.index;
      if (j != i) pairs.push_back({found.distance, i, j});
    }
  }
  std::ranges::sort(pairs, {},
                    [](const TruePair& pair) { return std::tuple(pair.length, pair.from, pair.to); });
  return pairs;
}

/// Counts the landmarks `around` that lie on one of the world. Most hypotheses are wrong and end early.
void PlaceMatcher::rate(Hypothesis& hypothesis, std::span<const Index> around) const {
  constexpr Index first_look = 7;  // [-] landmarks, the two that always fit included
  const double radius = near_share * spacing_;
  for (Index i = 0; i < around.size(); ++i) {
    if (i == first_look && hypothesis.score <= 3) return;
    const auto& found = true_.near(hypothesis.T_true_est * est(around[i]), radius, 1);
    if (found.empty()) continue;
    ++hypothesis.score;
    hypothesis.error += found.front().distance * found.front().distance;
  }
}

/// Lays the first landmark of `around` and one farther out on every pair of the world that is as long.
/// Returns the positions where more than half of `around` fit, the best first.
std::vector<Hypothesis> PlaceMatcher::hypotheses(std::span<const Index> around,
                                                 std::span<const TruePair> pairs) const {
  const Vector2d& begin = est(around.front());
  const Vector2d& end = est(around[std::min(far_end, around.size() - 1)]);
  const double length = (end - begin).norm();
  const double tolerance = near_share * spacing_;
  std::vector<Hypothesis> found;
  for (auto pair = std::ranges::lower_bound(pairs, length - tolerance, {}, &TruePair::length);
       pair != pairs.end() && pair->length <= length + tolerance; ++pair) {
    Hypothesis hypothesis{.T_true_est = motion_between(begin, end, truth(pair->from), truth(pair->to))};
    rate(hypothesis, around);
    if (2 * hypothesis.score > around.size()) found.push_back(hypothesis);
  }
  std::ranges::stable_sort(found, [](const Hypothesis& a, const Hypothesis& b) {
    return a.score != b.score ? a.score > b.score : a.error < b.error;
  });
  return found;
}

/// Those that are nearly as good as the best and bring the landmark at `p_est` to different places, up to one
/// more than most_places.
std::vector<Hypothesis> PlaceMatcher::distinct(std::vector<Hypothesis> all, const Vector2d& p_est) const {
  constexpr double one_turn = 0.5;  // [rad]
  std::vector<Hypothesis> places;
  for (const Hypothesis& hypothesis : all) {
    if (5 * hypothesis.score < 4 * all.front().score || places.size() > most_places) break;
    const auto is_same = [&](const Hypothesis& other) {
      const seif::Pose2& a = hypothesis.T_true_est;
      const seif::Pose2& b = other.T_true_est;
      return (a * p_est - b * p_est).norm() < 0.5 * spacing_ &&
             std::abs(seif::wrap_angle(a.theta - b.theta)) < one_turn;
    };
    if (std::ranges::none_of(places, is_same)) places.push_back(hypothesis);
  }
  return places;
}

/// Aligns more and more landmarks, from the neighbourhood outwards. Empty if two positions fit nearly equally
/// well.
std::optional<Match> PlaceMatcher::best_of(std::span<const Hypothesis> places,
                                           std::span<const Index> outwards) const {
  std::vector<Match> matches;
  for (const Hypothesis& place : places) {
    seif::Pose2 T_true_est = place.T_true_est;
    for (Index count = neighbourhood; count < outwards.size(); count *= 2)
      T_true_est = refined(T_true_est, outwards.first(count));
    matches.push_back(match(refined(T_true_est, outwards)));
    std::ranges::sort(matches.back().pairs, {}, &IndexPair::est);
  }
  std::erase_if(matches, [&](const Match& match) { return !fits(match); });
  std::ranges::stable_sort(matches, std::ranges::greater{},
                           [](const Match& match) { return match.pairs.size(); });
  if (matches.empty() || matches.front().pairs.size() < least_for_search) return std::nullopt;
  const auto is_same = [&](const Match& other) {
    return std::ranges::equal(other.pairs, matches.front().pairs, {}, &IndexPair::truth, &IndexPair::truth);
  };
  for (const Match& other : matches) {
    if (5 * other.pairs.size() > 4 * matches.front().pairs.size() && !is_same(other)) return std::nullopt;
  }
  return matches.front();
}

std::optional<Match> PlaceMatcher::search() const {
  if (std::min(map_.size(), true_.points().size()) < least_for_search) return std::nullopt;
  constexpr Index work = 600'000;  // [-] neighbourhoods times true landmarks
  const Index tries = std::clamp<Index>(work / true_.points().size(), 3, 30);
  const std::vector<TruePair> pairs = true_pairs();
  Index ambiguous = 0;
  for (const Index first : spread_sample(map_.size(), tries)) {
    std::vector<Index> outwards = all_;
    std::ranges::stable_sort(outwards, {}, [&](Index i) { return (est(i) - est(first)).norm(); });
    const auto around = std::span(outwards).first(std::min(neighbourhood, outwards.size()));
    const std::vector<Hypothesis> places = distinct(hypotheses(around, pairs), est(first));
    if (places.empty()) continue;
    if (places.size() <= most_places) {
      if (std::optional<Match> match = best_of(places, outwards)) return match;
    } else if (++ambiguous == most_ambiguous) {
      break;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<seif::LandmarkId>> match_by_place(std::span<const MapRecord> map,
                                                            std::span<const TrueLandmark> truth,
                                                            const std::optional<seif::Pose2>& T_true_est) {
  if (map.empty() || truth.empty()) return std::nullopt;
  const PlaceMatcher matcher(map, truth);
  std::optional<Match> match;
  if (T_true_est) match = matcher.match_at(*T_true_est);
  if (!match) match = matcher.search();
  if (!match) return std::nullopt;
  std::vector<seif::LandmarkId> ids(map.size(), seif::no_landmark);
  for (const IndexPair& pair : match->pairs) ids[pair.est] = truth[pair.truth].landmark;
  return ids;
}

}  // namespace harness
