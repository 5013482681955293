#include "seif/relocating/relocating_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "seif/relocating/contradiction.hpp"

namespace seif {
namespace {

/// [-] The chi-square quantile of two degrees of freedom at 1 - 1e-6. Within it by the sensor's noise alone, v' Q^-1 v,
/// nothing has to be computed.
constexpr double near_enough = 27.63;
/// Whether the filter's gate shuts out so much that it may be the pose that is wrong:
constexpr int most_shut_out_scans = 3;     // [-] in a row, of which it uses nothing
constexpr std::int64_t most_shut_out = 4;  // [-] observations of known landmarks
constexpr std::size_t most_around = 24;    // [-] landmarks of the local map that are looked for
constexpr std::size_t most_bases = 12;     // [-] of these, for hypotheses
constexpr int fewest_scans = 2;            // [-] of a local map
constexpr int scans_until_trusted = 3;     // [-] in a row that fit again
/// Two landmarks that agree lie within this of where they should, before their covariances are known.
constexpr double rough_m = 0.5;  // [m]
constexpr double rough = 0.1;    // [-] of their distance
/// So many landmarks must have vanished that lie well within the view, as a share of it.
constexpr std::size_t fewest_vanished = 3;                // [-]
constexpr double clear_reach = 0.7, clear_bearing = 0.8;  // [-]

}  // namespace

RelocatingFilter::RelocatingFilter(std::unique_ptr<Estimator> filter, LocalMap::MakeFilter make_local,
                                   const EstimatorSetup& setup)
    : FilterAround(std::move(filter)),
      belief_(belief_for("relocate")),
      T_robot_sensor_(setup.T_robot_sensor),
      local_(std::move(make_local), setup.T_robot_sensor) {}

void RelocatingFilter::motion_update(const Odometry& odometry) {
  filter_->motion_update(odometry);
  if (has_doubt_) local_.motion_update(odometry);
}

void RelocatingFilter::measurement_update(const Scan& scan, const StageDone& done) {
  if (!has_doubt_) {
    const bool is_near = is_near_expected(scan);
    if (!is_shut_out() && (is_near || judge(scan) != Verdict::contradicts) && !has_vanished(scan)) {
      remember(scan);
      take_in(scan, is_near, done);
      return;
    }
    begin_search();
  }
  remember(scan);
  follow(scan);
  if (!has_doubt_) {
    filter_->measurement_update(scan, done);
    return;
  }
  search(scan);
  empty_.t = scan.t;
  filter_->measurement_update(empty_, done);
}

/// Notes whether the filter's own gate shuts out all that it sees of known landmarks. A scan that is near shows that the
/// pose is right. Then nobody needs the filter's counts, which take time.
void RelocatingFilter::take_in(const Scan& scan, bool is_near, const StageDone& done) {
  if (is_near) {
    const bool sees_known = std::ranges::any_of(
        scan.observations, [&](const Observation& z) { return belief_.is_at_hand(z.landmark); });
    if (sees_known) forget_shut_out();
    filter_->measurement_update(scan, done);
    return;
  }
  const std::int64_t before = filter_->counts().gated;
  filter_->measurement_update(scan, done);
  const Counts counts = filter_->counts();
  if (counts.innovation_degrees > 0) {
    forget_shut_out();
  } else if (counts.gated > before) {
    ++shut_out_scans_;
    shut_out_ += counts.gated - before;
  }
}

void RelocatingFilter::forget_shut_out() {
  shut_out_scans_ = 0;
  shut_out_ = 0;
}

/// So near to what the filter expects that no covariance has to be known.
bool RelocatingFilter::is_near_expected(const Scan& scan) const {
  const Pose2 pose = filter_->pose();
  return std::ranges::all_of(scan.observations, [&](const Observation& z) {
    if (!belief_.is_at_hand(z.landmark)) return true;
    const Eigen::Vector2d v =
        innovation(z, predict_observation(pose, T_robot_sensor_, belief_.mean_of(z.landmark)).z);
    return v.dot(z.covariance.inverse() * v) <= near_enough;
  });
}

bool RelocatingFilter::is_shut_out() const {
  return shut_out_scans_ >= most_shut_out_scans && shut_out_ >= most_shut_out;
}

/// By the majority of its observations of known landmarks. Where the filter's gate has begun the search, they must come
/// as near as a consistent filter expects.
RelocatingFilter::Verdict RelocatingFilter::judge(const Scan& scan) {
  ids_.clear();
  for (const Observation& z : scan.observations) {
    if (belief_.is_at_hand(z.landmark)) ids_.push_back(z.landmark);
  }
  if (ids_.empty()) return Verdict::says_nothing;
  belief_.begin_association(scan.t);
  const auto n = static_cast<Eigen::Index>(3 + 2 * ids_.size());
  if (Sigma_.rows() < n) Sigma_.resize(2 * n, 2 * n);
  auto Sigma = Sigma_.topLeftCorner(n, n);
  belief_.covariance_with(ids_, Sigma);
  const double most = is_shut_out() ? near_enough : contradiction;
  std::size_t against = 0;
  Eigen::Index row = 3;
  for (const Observation& z : scan.observations) {
    if (!belief_.is_at_hand(z.landmark)) continue;
    const ExpectedObservation expected = belief_.expect(z.landmark, z);
    Eigen::Matrix<double, 2, 5> J;
    J << expected.J_x, expected.J_m;
    Eigen::Matrix<double, 5, 5> P;
    P << Sigma.topLeftCorner<3, 3>(), Sigma.block<3, 2>(0, row), Sigma.block<2, 3>(row, 0),
        Sigma.block<2, 2>(row, row);
    const Eigen::Matrix2d S = J * P * J.transpose() + z.covariance;
    if (!(expected.v.dot(S.inverse() * expected.v) <= most)) ++against;
    row += 2;
  }
  return 2 * against > ids_.size() ? Verdict::contradicts : Verdict::fits;
}

/// Whether the robot was carried off among landmarks that it has never seen: nothing of what it has just seen, and should
/// see, is there, and something else is.
bool RelocatingFilter::has_vanished(const Scan& scan) {
  if (scan.observations.size() < 2 || last_seen_.size() < fewest_vanished) return false;
  for (const Observation& z : scan.observations) {
    if (std::ranges::find(last_seen_, z.landmark) != last_seen_.end() || belief_.is_at_hand(z.landmark))
      return false;
  }
  const Pose2 T_sensor_world = inverse(filter_->pose() * T_robot_sensor_);
  const auto is_in_view = [&](LandmarkId id) {
    if (!belief_.is_at_hand(id)) return false;
    return SensorView::is_within(T_sensor_world * belief_.mean_of(id), clear_reach * view_.reach(),
                                 clear_bearing * view_.widest_bearing());
  };
  return std::cmp_greater_equal(std::ranges::count_if(last_seen_, is_in_view), fewest_vanished);
}

void RelocatingFilter::remember(const Scan& scan) {
  if (scan.observations.empty()) return;
  view_.widen(scan.observations);
  last_seen_.clear();
  for (const Observation& z : scan.observations) last_seen_.push_back(z.landmark);
}

void RelocatingFilter::begin_search() {
  has_doubt_ = true;
  fitting_scans_ = 0;
  local_.begin();
}

void RelocatingFilter::end_search() {
  has_doubt_ = false;
  forget_shut_out();
  local_.end();
}

/// What contradicts once may be an outlier: when the scans fit again, the filter goes on.
void RelocatingFilter::follow(const Scan& scan) {
  const Verdict verdict = judge(scan);
  if (verdict == Verdict::contradicts) fitting_scans_ = 0;
  if (verdict == Verdict::fits) ++fitting_scans_;
  if (fitting_scans_ >= scans_until_trusted) end_search();
}

void RelocatingFilter::search(const Scan& scan) {
  held_back_ += static_cast<std::int64_t>(scan.observations.size());
  local_.measurement_update(scan);
  const Counts counts = local_.filter().counts();
  if (counts.innovation && counts.innovation_degrees > 0 &&
      *counts.innovation > 0.5 * contradiction * counts.innovation_degrees) {
    local_.begin();  // it has slipped or was carried off again
    local_.measurement_update(scan);
  }
  if (local_.scans() < fewest_scans) return;
  surroundings_ = local_.read(scan.t, most_around);
  pair_by_names();
  if (const std::optional<Placement> placement = place(scan.t)) tell_filter(*placement, scan.t);
}

void RelocatingFilter::pair_by_names() {
  filter_->landmarks(surroundings_.landmarks, found_);
  known_.clear();
  known_at_.clear();
  std::size_t next = 0;
  for (const LandmarkEstimate& estimate : found_) {
    while (surroundings_.landmarks[next] != estimate.landmark) ++next;
    known_.push_back({next, estimate.landmark});
    known_at_.push_back(estimate.mean);
  }
}

/// Of all poses that two pairs give, the one to which most pairs fit.
bool RelocatingFilter::choose_most_that_agree(Placement& placement) const {
  std::size_t most = 1;
  const std::size_t bases = std::min(known_.size(), most_bases);
  for (std::size_t a = 0; a < bases; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Eigen::Vector2d a_robot = surroundings_.at(known_[a].around);
      const Eigen::Vector2d b_robot = surroundings_.at(known_[b].around);
      const Pose2 T = pose_from(a_robot, b_robot, known_at_[a], known_at_[b]);
      std::vector<Pairing> agreeing;
      for (std::size_t i = 0; i < known_.size(); ++i) {
        const Eigen::Vector2d p = surroundings_.at(known_[i].around);
        const double allowed = rough_m + rough * (p - 0.5 * (a_robot + b_robot)).norm();
        if ((T * p - known_at_[i]).norm() <= allowed) agreeing.push_back(known_[i]);
      }
      if (agreeing.size() <= most) continue;
      most = agreeing.size();
      placement.T_world_robot = T;
      placement.pairs = std::move(agreeing);
    }
  }
  return most >= 2 && 2 * most > known_.size();
}

/// Where most of the known landmarks agree, by the filter's own covariance.
std::optional<Placement> RelocatingFilter::place(double t) {
  Placement placement;
  if (!choose_most_that_agree(placement)) return std::nullopt;
  ids_.clear();
  for (const Pairing& pair : placement.pairs) ids_.push_back(pair.landmark);
  belief_.begin_association(t);
  if (!belief_.bring(ids_)) throw NumericalFailure("relocation", t);
  if (!fit_most(belief_, surroundings_, std::max<std::size_t>(2, known_.size() / 2 + 1), placement))
    return std::nullopt;
  return placement;
}

/// Landmarks that are known, and lie elsewhere, are left out.
void RelocatingFilter::tell_filter(const Placement& placement, double t) {
  surroundings_ = local_.read(t, LocalMap::most_carried);  // those that were looked for come first
  pair_by_names();
  std::vector<bool> is_used(surroundings_.size(), true);
  for (const Pairing& pair : known_) is_used[pair.around] = false;
  for (const Pairing& pair : placement.pairs) is_used[pair.around] = true;
  belief_.relocate(
      relocation_to(belief_, filter_->pose(), surroundings_, placement, surroundings_.landmarks, is_used));
  end_search();
}

Counts RelocatingFilter::counts() const {
  Counts counts = filter_->counts();
  counts.gated += held_back_;
  return counts;
}

std::size_t RelocatingFilter::memory_bytes() const {
  return filter_->memory_bytes() + (local_.is_begun() ? local_.filter().memory_bytes() : 0);
}

}  // namespace seif
