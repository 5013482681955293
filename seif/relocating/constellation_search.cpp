#include "seif/relocating/constellation_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "seif/relocating/rigid_fit.hpp"

namespace seif {
namespace {

constexpr std::int64_t most_triangles = 2000;  // [-] of the map, after which a call begins no further corner
constexpr std::int64_t most_of_corner = 30'000;  // [-] triangles, and poses that they give
constexpr std::size_t most_hypotheses = 8;       // [-] that are kept
constexpr std::size_t fewest_fitting = 3;        // [-] points of a pose that is remembered
constexpr std::size_t corners_before = 8;        // [-] that must have been looked from before a pose is told
constexpr double least_share = 0.6;              // [-] of what lies among the points that fit
constexpr double least_lead = 9.2;               // [nat] over any other pose
constexpr int climbs = 5;                        // [-] of pairs and pose in turn
constexpr double alike_m = 1.0;                  // [m]
constexpr double alike_rad = 0.2;                // [rad]
constexpr std::size_t most_counted = 256;        // [-] landmarks, for their density

}  // namespace

void ConstellationSearch::set_points(const Points& points, const Pose2& T_local_robot,
                                     const Pose2& T_world_robot) {
  around_ = points;
  T_local_robot_ = T_local_robot;
  T_world_robot_ = T_world_robot;
  radius_ = near_;
  for (const Eigen::Vector2d& p : around_.p_local)
    radius_ = std::max(radius_, (p - Eigen::Vector2d(T_local_robot.x, T_local_robot.y)).norm());
  density_ = static_cast<double>(around_.p_local.size()) / (std::numbers::pi * radius_ * radius_);
  for (Hypothesis& hypothesis : hypotheses_)
    hypothesis = rated(hypothesis.T_world_local, count(hypothesis.T_world_local, 0));
  std::ranges::stable_sort(hypotheses_, std::ranges::greater(), &Hypothesis::score);
}

void ConstellationSearch::look_around() {
  if (around_.p_local.size() < fewest_fitting) return;
  const std::int64_t until = work_ + most_triangles;
  for (std::size_t i = 0; i < around_.p_local.size() && work_ < until; ++i)
    look_from(next_corner_++ % around_.p_local.size(),
              {.triangles = most_of_corner, .poses = most_of_corner});
}

void ConstellationSearch::look_from(std::size_t corner, const Limits& limits) {
  until_ = {.triangles = work_ + limits.triangles, .poses = poses_ + limits.poses};
  ++corners_done_;
  std::vector<int> others(around_.p_local.size());
  std::iota(others.begin(), others.end(), 0);
  std::erase(others, static_cast<int>(corner));
  const auto distance = [&](int i) {
    return (around_.p_local[static_cast<std::size_t>(i)] - around_.p_local[corner]).squaredNorm();
  };
  std::ranges::stable_sort(others, {}, distance);
  if (others.size() > ConstellationIndex::neighbours) others.resize(ConstellationIndex::neighbours);
  for (std::size_t i = 0; i < others.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::array<int, 3> corners{static_cast<int>(corner), others[i], others[j]};
      const auto at = [&](std::size_t c) { return around_.p_local[static_cast<std::size_t>(corners[c])]; };
      Triangle triangle = triangle_of(corners, {at(0), at(1), at(2)}, index_.width());
      if (!triangle.is_sharp) continue;
      const double longest = triangle.sides(0);
      for (int turn = 0; turn < 3; ++turn) {  // in the map another side may be the longest, by noise
        if (triangle.sides(0) >= longest - index_.width()) try_triangle(triangle);
        std::ranges::rotate(triangle.corners, triangle.corners.begin() + 1);
        triangle.sides = Eigen::Vector3d(triangle.sides(1), triangle.sides(2), triangle.sides(0));
      }
    }
  }
}

void ConstellationSearch::try_triangle(const Triangle& triangle) {
  const auto at = [&](std::size_t c) {
    return around_.p_local[static_cast<std::size_t>(triangle.corners[c])];
  };
  index_.for_each_like(triangle.sides, [&](const std::array<LandmarkId, 3>& corners) {
    if (work_ >= until_.triangles || poses_ >= until_.poses) return;
    ++work_;
    if (!may_be(triangle, corners)) return;
    const Pose2 T = pose_from(at(0), at(1), grid_.position(corners[0]), grid_.position(corners[1]));
    if ((T * at(2) - grid_.position(corners[2])).norm() > near_) return;
    ++poses_;
    if (!is_of_map() || fits_nearby(T)) try_pose(T);
  });
}

bool ConstellationSearch::may_be(const Triangle& triangle, const std::array<LandmarkId, 3>& corners) const {
  for (std::size_t c = 0; c < 3; ++c) {
    if (!grid_.has(corners[c]) || is_own(static_cast<std::size_t>(triangle.corners[c]), corners[c]))
      return false;
  }
  if (!is_of_map()) return true;
  const Eigen::Vector2d& p = around_.p_local[static_cast<std::size_t>(triangle.corners[0])];
  return (grid_.position(corners[0]) - p).norm() <= around_.farthest;
}

/// A robot that has come back is in the middle of what it knows.
bool ConstellationSearch::fits_nearby(const Pose2& T_world_local) const {
  constexpr std::size_t nearest = 8;  // [-] points
  std::size_t fitting = 0;
  for (std::size_t i = 0; i < std::min(nearest, around_.p_local.size()); ++i) {
    find_near(i, T_world_local, 1);
    if (!found_near_.empty()) ++fitting;
  }
  return fitting >= fewest_fitting;
}

void ConstellationSearch::try_pose(const Pose2& T_world_local) {
  constexpr std::size_t most_behind = 4;  // [-] points: with fewer a pose does not become one of the best
  const bool is_full = hypotheses_.size() == most_hypotheses;
  const std::size_t worst = is_full ? hypotheses_.back().fitting : 0;
  const std::size_t needed = std::max(fewest_fitting, worst > most_behind ? worst - most_behind : 0);
  const std::size_t fitting = count(T_world_local, needed);
  if (fitting < needed) return;
  const Hypothesis hypothesis = rated(T_world_local, fitting);
  if (!is_full || hypothesis.score > hypotheses_.back().score) remember(hypothesis);
}

/// Were the landmarks scattered at random, as densely as here, a point would have one within near_ with probability
/// p = 1 - exp(-density pi near_^2). The fewer places are no farther away, the less is it chance.
ConstellationSearch::Hypothesis ConstellationSearch::rated(const Pose2& T_world_local,
                                                           std::size_t fitting) const {
  const double p = 1.0 - std::exp(-density_ * std::numbers::pi * near_ * near_);
  const double score = -static_cast<double>(fitting) * std::log(p) - log_places(T_world_local, density_);
  return {.T_world_local = T_world_local, .fitting = fitting, .score = score};
}

/// Landmarks that a point may be taken for.
void ConstellationSearch::find_near(std::size_t point, const Pose2& T_world_local, std::size_t most) const {
  grid_.find_near(T_world_local * around_.p_local[point], near_, is_of_map() ? most + 1 : most, found_near_);
  std::erase_if(found_near_, [&](const LandmarkGrid::Near& near) { return is_own(point, near.landmark); });
}

/// How many points have a landmark; 0 as soon as fewer than `at_least` can have.
std::size_t ConstellationSearch::count(const Pose2& T_world_local, std::size_t at_least) const {
  std::size_t fitting = 0;
  for (std::size_t i = 0; i < around_.p_local.size(); ++i) {
    if (fitting + around_.p_local.size() - i < at_least) return 0;
    find_near(i, T_world_local, 1);
    if (!found_near_.empty()) ++fitting;
  }
  return fitting;
}

/// Two poses that put the robot at the same place are one.
bool ConstellationSearch::is_alike(const Pose2& a, const Pose2& b) const {
  const Pose2 from_a = a * T_local_robot_;
  const Pose2 from_b = b * T_local_robot_;
  return std::hypot(from_a.x - from_b.x, from_a.y - from_b.y) <= alike_m &&
         std::abs(wrap_angle(from_a.theta - from_b.theta)) <= alike_rad;
}

/// The best first.
void ConstellationSearch::remember(const Hypothesis& hypothesis) {
  const auto same = std::ranges::find_if(
      hypotheses_, [&](const Hypothesis& h) { return is_alike(h.T_world_local, hypothesis.T_world_local); });
  if (same != hypotheses_.end()) {
    if (same->score < hypothesis.score) *same = hypothesis;
  } else {
    if (hypotheses_.size() == most_hypotheses) hypotheses_.pop_back();
    hypotheses_.push_back(hypothesis);
  }
  std::ranges::stable_sort(hypotheses_, std::ranges::greater(), &Hypothesis::score);
}

/// Each point with the nearest landmark, each landmark once.
void ConstellationSearch::pair(const Pose2& T_world_local, std::vector<Pairing>& pairs) const {
  struct Near {
    double distance;
    Pairing pairing;
  };
  std::vector<Near> all;
  for (std::size_t i = 0; i < around_.p_local.size(); ++i) {
    find_near(i, T_world_local, 4);
    for (const LandmarkGrid::Near& near : found_near_) all.push_back({near.distance, {i, near.landmark}});
  }
  std::ranges::stable_sort(all, {}, &Near::distance);
  pairs.clear();
  for (const Near& near : all) {
    const bool is_taken = std::ranges::any_of(pairs, [&](const Pairing& p) {
      return p.around == near.pairing.around || p.landmark == near.pairing.landmark;
    });
    if (!is_taken) pairs.push_back(near.pairing);
  }
}

/// Pairs and pose in turn, as long as more fits.
Pose2 ConstellationSearch::climb(Pose2 T_world_local, std::vector<Pairing>& pairs) const {
  pair(T_world_local, pairs);
  for (int round = 0; round < climbs; ++round) {
    std::vector<Eigen::Vector2d> from, to;
    for (const Pairing& p : pairs) {
      from.push_back(around_.p_local[p.around]);
      to.push_back(grid_.position(p.landmark));
    }
    const std::optional<Pose2> fitted = rigid_fit(from, to);
    if (!fitted) return T_world_local;
    std::vector<Pairing> more;
    pair(*fitted, more);
    if (more.size() < pairs.size()) return T_world_local;
    T_world_local = *fitted;
    pairs = std::move(more);
  }
  return T_world_local;
}

std::optional<ConstellationSearch::Found> ConstellationSearch::best() const {
  if (hypotheses_.empty() || corners_done_ < std::min(around_.p_local.size(), corners_before))
    return std::nullopt;
  if (!is_alone()) return std::nullopt;
  const Hypothesis& first = hypotheses_.front();
  Found found{.T_world_local = first.T_world_local, .pairs = {}};
  found.T_world_local = climb(first.T_world_local, found.pairs);
  if (found.pairs.size() < fewest_fitting || !is_complete(found)) return std::nullopt;
  found.density = density_at(found.T_world_local);
  found.log_places = log_places(found.T_world_local, found.density);
  return found;
}

/// Whether no other pose is nearly as good as the first.
bool ConstellationSearch::is_alone() const {
  const Hypothesis& first = hypotheses_.front();
  return std::ranges::none_of(hypotheses_, [&](const Hypothesis& other) {
    return !is_alike(other.T_world_local, first.T_world_local) && other.score > first.score - least_lead;
  });
}

bool ConstellationSearch::is_ambiguous() const {
  if (hypotheses_.empty()) return false;
  const Hypothesis& first = hypotheses_.front();
  return std::ranges::any_of(hypotheses_, [&](const Hypothesis& other) {
    return !is_alike(other.T_world_local, first.T_world_local) && 2 * other.fitting > first.fitting + 1;
  });
}

/// Whether enough of what lies among the points that fit does so: of the points and of the landmarks, whichever is less.
bool ConstellationSearch::is_complete(const Found& found) const {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // of the points that fit
  for (const Pairing& pair : found.pairs) centre += around_.p_local[pair.around];
  centre /= static_cast<double>(found.pairs.size());
  double radius = 0.0;
  for (const Pairing& pair : found.pairs)
    radius = std::max(radius, (around_.p_local[pair.around] - centre).norm());
  const auto points = static_cast<std::size_t>(std::ranges::count_if(
      around_.p_local, [&](const Eigen::Vector2d& p) { return (p - centre).norm() <= radius; }));
  grid_.find_near(found.T_world_local * centre, radius, most_counted, found_near_);
  const std::size_t fewer = std::min(points, std::max(found_near_.size(), found.pairs.size()));
  return static_cast<double>(found.pairs.size()) >= least_share * static_cast<double>(fewer);
}

/// Of the map around the robot. [1/m^2]
double ConstellationSearch::density_at(const Pose2& T_world_local) const {
  grid_.find_near(T_world_local * Eigen::Vector2d(T_local_robot_.x, T_local_robot_.y), radius_, most_counted,
                  found_near_);
  return static_cast<double>(std::max<std::size_t>(found_near_.size(), 1)) /
         (std::numbers::pi * radius_ * radius_);
}

/// Those that put the robot no farther from where the filter believes it, and turn it no more, in units of 1 m^2 and
/// 1 rad; at most those of the whole map.
double ConstellationSearch::log_places(const Pose2& T_world_local, double density) const {
  constexpr double least_turn = 0.1;  // [rad]
  const Pose2 there = T_world_local * T_local_robot_;
  const double d = std::hypot(there.x - T_world_robot_.x, there.y - T_world_robot_.y) + near_;
  const double turn =
      std::min(std::numbers::pi, std::abs(wrap_angle(there.theta - T_world_robot_.theta)) + least_turn);
  const double near_belief = std::numbers::pi * d * d * 2.0 * turn;
  const double all = 2.0 * std::numbers::pi * static_cast<double>(grid_.size()) / density;
  return std::log(std::min(near_belief, all));
}

}  // namespace seif
