#include "seif/seif.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "seif/couplings.hpp"
#include "seif/marginals.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/motion_update.hpp"
#include "seif/sparsification.hpp"

namespace seif {
namespace {

constexpr int most_relinearisations = 4;  // [-] in one update

/// Of where it has seen the landmark, along the worse of range and bearing [m].
double sd_of_sighting(const Observation& observation) {
  const Eigen::Matrix2d& Q = observation.covariance;
  return std::sqrt(std::max(Q(0, 0), observation.range * observation.range * Q(1, 1)));
}

}  // namespace

Seif::Seif(const EstimatorSetup& setup, const SeifOptions& options)
    : options_(options),
      state_(setup.start),
      mean_(options.multilevel),
      tree_(options.tree, setup.start.mean),
      by_tree_(options.mean_recovery == SeifMean::tree),
      T_robot_sensor_(setup.T_robot_sensor) {
  if (options_.gate > 0.0 && !by_tree_) throw std::invalid_argument("gate needs mean_recovery: tree");
  if (options_.robust_above > 0.0 && !by_tree_)
    throw std::invalid_argument("robust_above needs mean_recovery: tree");
  if (options_.first_estimates > 0) state_.use_first_estimates(options_.first_estimates);
}

void Seif::motion_update(const Odometry& odometry) { seif::motion_update(state_, odometry); }

void Seif::measurement_update(const Scan& scan, const StageDone& done) {
  state_.begin_scan();
  activate_known(scan);
  if (!by_tree_) mean_.before_information(state_);
  add_known(scan);
  solve_window(scan.t);
  if (by_tree_) note_innovation();
  relinearise(scan.t);
  if (!add_new(scan)) solve_window(scan.t);
  state_.update_first_estimates();
  if (!by_tree_) mean_.after_information(state_);
  done(Stage::measurement);

  sparsify(scan.t);
  done(Stage::sparsification);

  recover_mean(scan.t);
  done(Stage::mean_recovery);
}

void Seif::activate_known(const Scan& scan) {
  seen_.clear();
  double range = 0.0;
  double sighting_sd = 0.0;
  for (const Observation& observation : scan.observations) {
    range = std::max(range, observation.range);
    sighting_sd = std::max(sighting_sd, sd_of_sighting(observation));
    if (const auto slot = state_.find(observation.landmark)) seen_.push_back(*slot);
  }
  if (sighting_sd > 0.0) state_.note_sighting_sd(sighting_sd);
  for (const auto& [a, b] : equal_) {
    for (const int slot : {a, b}) {
      if (std::ranges::find(seen_, slot) == seen_.end()) seen_.push_back(slot);
    }
  }
  if (by_tree_ && !tree_.activate(state_, seen_, range)) throw NumericalFailure("activation", scan.t);
  for (const int slot : seen_) {
    if (state_.position(slot) < 0) mean_.activate(state_, slot);
    state_.mark_seen(slot);
  }
}

/// m_a - m_b = 0, of landmarks that are active. Where their first estimates lie apart, turning everything
/// must move this as it moves them, or the filter would learn a heading from it.
void Seif::add_equal(double t) {
  if (equal_.empty()) return;
  for (const auto& [a, b] : equal_) {
    if (state_.position(a) < 0 || state_.position(b) < 0) continue;
    const Eigen::Vector2d apart = state_.mean(a) - state_.mean(b);
    Eigen::Vector2d lever = Eigen::Vector2d::Zero();
    if (state_.uses_first_estimates())
      lever = state_.lever(a, state_.mean(a)) - state_.lever(b, state_.mean(b));
    Eigen::Matrix<double, 2, 7> J;  // wrt [x y theta a b]
    J << Eigen::Matrix2d::Zero(), Eigen::Vector2d(lever.y(), -lever.x()), Eigen::Matrix2d::Identity(),
        -Eigen::Matrix2d::Identity();
    const int row_a = InformationState::row_of(state_.position(a));
    const int row_b = InformationState::row_of(state_.position(b));
    const std::array rows{0, 1, 2, row_a, row_a + 1, row_b, row_b + 1};
    constexpr double weight = 1.0 / (equal_sd * equal_sd);
    state_.Omega()(rows, rows) += weight * (J.transpose() * J);
    state_.r()(rows) -= weight * (J.transpose() * apart);
    state_.touch(6);
  }
  equal_.clear();
  solve_window(t);  // what it moves is no innovation of the scan
}

/// All linearised before the first is added.
void Seif::add_known(const Scan& scan) {
  add_equal(scan.t);
  factors_.clear();
  for (const Observation& observation : scan.observations) {
    const std::optional<int> slot = state_.find(observation.landmark);
    if (!slot || state_.position(*slot) < 0) continue;
    factors_.push_back(is_closing(*slot, observation)
                           ? linearise_at_measurement(state_, *slot, observation, T_robot_sensor_)
                           : linearise(state_, *slot, observation, T_robot_sensor_));
  }
  if (options_.gate > 0.0 || options_.robust_above > 0.0) check_innovations(scan.t);
  for (const ObservationFactor& factor : factors_) add(state_, factor);
}

/// v' S^-1 v of all factors together, from what the step has just left of them. With d the step of all means
/// and C the information before the scan, the least squared error of belief and scan is
///   d' C d + sum (v - J d)' Q^-1 (v - J d) = sum v' Q^-1 v - r' (C + sum J' Q^-1 J)^-1 r,
/// r = sum J' Q^-1 v, and it is v' S^-1 v with S = J C^-1 J' + Q. With the tree, r was zero before.
void Seif::note_innovation() {
  innovation_ = 0.0;
  for (const ObservationFactor& factor : factors_) innovation_ += squared_norm(factor.v, factor);
  innovation_ = std::max(0.0, innovation_ - tree_.lowered());
  innovation_degrees_ = 2 * static_cast<int>(factors_.size());
}

/// Leaves out those that are too far from what was expected, and weakens those that are far from it. Each is
/// looked at by itself, before any of the scan is added.
void Seif::check_innovations(double t) {
  if (factors_.empty()) return;
  solve_window(t);  // for its factor; where r is zero already, nothing moves
  gated_ += static_cast<std::int64_t>(std::erase_if(factors_, [this](ObservationFactor& factor) {
    const double squared = squared_mahalanobis(factor);
    if (options_.gate > 0.0 && squared > options_.gate) return true;
    const double times = times_above(squared, options_.robust_above);
    factor.observation.covariance *= times;
    factor.Q_inverse /= times;
    if (times > 1.0) ++weakened_;
    return false;
  }));
}

/// v' S^-1 v with S = J (L L')^-1 J' + Q, where L is the factor that solve_window() leaves in work(): that of
/// the information on the window with all else eliminated.
double Seif::squared_mahalanobis(const ObservationFactor& factor) {
  const int w = state_.window_size();
  if (J_by_factor_.rows() < w) J_by_factor_.resize(2 * w, 2);
  auto Y = J_by_factor_.topRows(w);
  Y.setZero();
  Y.topRows<3>() = factor.J_x.transpose();
  Y.middleRows<2>(InformationState::row_of(state_.position(factor.slot))) = factor.J_m.transpose();
  state_.work().triangularView<Eigen::Lower>().solveInPlace(Y);
  const Eigen::Matrix2d S = Y.transpose() * Y + factor.observation.covariance;
  const Eigen::Vector2d v = residual(state_, factor);
  return v.dot(S.inverse() * v);
}

/// Whether the landmark is seen so far from where it is believed to be that the direction to it is useless.
bool Seif::is_closing(int slot, const Observation& observation) const {
  if (options_.closing_gate <= 0.0) return false;
  const Eigen::Vector2d seen_at =
      invert_observation(state_.pose(), T_robot_sensor_, observation).p_world_landmark;
  return (seen_at - state_.mean(slot)).norm() > options_.closing_gate * observation.range;
}

/// Takes out those factors that the step has moved too far from where they are linear, and puts them in again
/// where the mean is now.
void Seif::relinearise(double t) {
  const double most = options_.relinearise_above * options_.relinearise_above;
  for (int round = 0; round < most_relinearisations; ++round) {
    bool any = false;
    for (ObservationFactor& factor : factors_) {
      const ObservationFactor now = linearise(state_, factor.slot, factor.observation, T_robot_sensor_);
      Eigen::Vector2d nonlinearity = now.v - residual(state_, factor);
      nonlinearity(1) = wrap_angle(nonlinearity(1));
      if (squared_norm(nonlinearity, factor) <= most) continue;
      subtract(state_, factor);
      add(state_, now);
      factor = now;
      any = true;
    }
    if (!any) return;
    solve_window(t);
  }
}

/// Landmarks never seen before, placed from the pose as the others have corrected it: their innovation is
/// zero. False if it is not, where one was seen more than once, and the window is to be solved for again.
bool Seif::add_new(const Scan& scan) {
  const int known = state_.landmark_count();
  bool seen_once = true;
  for (const Observation& observation : scan.observations) {
    std::optional<int> slot = state_.find(observation.landmark);
    if (slot && *slot < known) continue;
    if (slot) {
      seen_once = false;
    } else {
      slot = state_.add_landmark(
          observation.landmark,
          invert_observation(state_.pose(), T_robot_sensor_, observation).p_world_landmark);
      if (by_tree_) {
        tree_.join(state_, *slot);
      } else {
        mean_.join(state_, *slot);
      }
      state_.mark_seen(*slot);
    }
    add(state_, linearise(state_, *slot, observation, T_robot_sensor_));
  }
  return seen_once;
}

void Seif::solve_window(double t) {
  if (!(by_tree_ ? tree_.solve_window(state_) : mean_.solve_window(state_))) {
    throw NumericalFailure("local solve", t);
  }
}

/// In a burst: that costs less, and keeps more, than holding the bound at each update.
void Seif::sparsify(double t) {
  if (state_.active_count() <= std::max(options_.theta_x, options_.theta_max)) return;
  choose_to_drop(state_, DropOrder::least_recently_seen, state_.active_count() - options_.theta_x, to_drop_);
  std::erase_if(to_drop_, [this](int slot) { return state_.scans_since_seen(slot) == 0; });
  if (to_drop_.empty()) return;
  const std::optional<double> anchoring = seif::sparsify(state_, SparsificationRule::gauge_free, to_drop_);
  if (!anchoring) throw NumericalFailure("sparsification", t);
  anchoring_ += *anchoring;
  if (by_tree_ && !tree_.deactivate(state_, to_drop_)) throw NumericalFailure("sparsification", t);
}

/// With the tree the local solution is that of all. With the exact mean the groups never move, and stay out
/// of the way.
void Seif::recover_mean(double t) {
  if (by_tree_) {
    solve_window(t);
    return tree_.end_update(state_);
  }
  if (!(options_.mean_recovery == SeifMean::exact ? solve_mean(state_) : mean_.correct(state_))) {
    throw NumericalFailure("mean recovery", t);
  }
}

void Seif::landmarks_at_hand(std::vector<LandmarkId>& out) const {
  out.clear();
  tree_.for_each_in_zone([&](int slot) { out.push_back(state_.id(slot)); });
}

bool Seif::is_at_hand(LandmarkId landmark) const {
  const auto slot = state_.find(landmark);
  return slot && tree_.is_in_zone(*slot);
}

Eigen::Vector2d Seif::mean_of(LandmarkId landmark) const { return mean(state_.find(landmark).value()); }

ExpectedObservation Seif::expect(LandmarkId landmark, const Observation& observation) const {
  const ObservationFactor factor =
      linearise(state_, state_.find(landmark).value(), mean_of(landmark), observation, T_robot_sensor_);
  return {factor.v, factor.J_x, factor.J_m};
}

void Seif::covariance_with(std::span<const LandmarkId> landmarks, Eigen::Ref<Eigen::MatrixXd> out) const {
  asked_.clear();
  for (const LandmarkId landmark : landmarks) asked_.push_back(state_.find(landmark).value());
  tree_.covariance(state_, asked_, out);
}

void Seif::want(std::span<const LandmarkId> landmarks) {
  for (const LandmarkId landmark : landmarks) tree_.want(state_.find(landmark).value());
}

void Seif::equate(LandmarkId a, LandmarkId b) {
  equal_.emplace_back(state_.find(a).value(), state_.find(b).value());
}

Eigen::Vector2d Seif::mean(int slot) const {
  return by_tree_ ? tree_.mean(state_, slot) : mean_.mean(state_, slot);
}

std::size_t Seif::memory_bytes() const {
  return state_.memory_bytes() + mean_.memory_bytes() + tree_.memory_bytes();
}

Counts Seif::counts() const {
  return {.blocks_touched = state_.blocks_touched() + mean_.blocks_touched() + tree_.blocks_touched(),
          .active_landmarks = state_.active_count(),
          .links = state_.link_count(),
          .gated = gated_,
          .weakened = weakened_,
          .mean_residual = by_tree_ || options_.mean_recovery == SeifMean::exact
                               ? std::nullopt
                               : std::optional(mean_.residual()),
          .anchoring = anchoring_,
          .innovation = by_tree_ ? std::optional(innovation_) : std::nullopt,
          .innovation_degrees = innovation_degrees_};
}

void Seif::landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const {
  out.clear();
  for (const LandmarkId landmark : landmarks) {
    if (const auto slot = state_.find(landmark)) out.push_back({landmark, mean(*slot)});
  }
}

void Seif::couplings(LandmarkId of, std::vector<Coupling>& out) const { couplings_of(state_, of, out); }

Eigen::MatrixXd Seif::whole_belief_matrix() const { return dense_Omega_of(state_); }

std::vector<LandmarkEstimate> Seif::map() const {
  std::vector<LandmarkEstimate> map;
  for (int slot = 0; slot < state_.landmark_count(); ++slot) {
    map.push_back({state_.id(slot), mean(slot)});
  }
  return map;
}

std::optional<MarginalCovariances> Seif::marginal_covariances(std::span<const LandmarkId> landmarks) const {
  return marginals_of(state_, landmarks);
}

std::optional<std::vector<Eigen::MatrixXd>> Seif::joint_covariances(
    std::span<const LandmarkIds> groups) const {
  return joint_covariances_of(state_, groups);
}

}  // namespace seif
