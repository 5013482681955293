#include "seif/seif.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string_view>

#include "seif/exact_mean.hpp"
#include "seif/full_state.hpp"
#include "seif/groups/group_mean.hpp"
#include "seif/linearisation.hpp"
#include "seif/linearisation_noise.hpp"
#include "seif/marginals.hpp"
#include "seif/measurement_steps.hpp"
#include "seif/relocation.hpp"
#include "seif/sparsification.hpp"
#include "seif/start_points.hpp"
#include "seif/tree/tree_mean.hpp"

namespace seif {
namespace {

constexpr int most_relinearisations = 4;  // [-] in one update
/// [-] Second-order terms below this share of the sensor's variances are ignored.
constexpr double least_curvature = 0.1;

// Where a part of the map cannot be told to have turned, its frame stays fixed:
constexpr double most_heading_variance = 0.1;   // [rad^2] of the odometry between two scans
constexpr double most_bearing_variance = 0.01;  // [rad^2]
constexpr double least_sighting_variance =
    1e-10;  // [m^2] information beyond that is not turned without rounding

bool can_turn(const Observation& z) {
  const double across = z.range * z.range * z.covariance(1, 1);
  return z.covariance(1, 1) <= most_bearing_variance &&
         std::min(z.covariance(0, 0), across) >= least_sighting_variance;
}

EstimatorSetup in_start_frame(EstimatorSetup setup) {
  setup.start = StartFrame(setup.start).inner();
  return setup;
}

}  // namespace

Seif::Seif(const EstimatorSetup& setup, const SeifOptions& options)
    : InformationFilter(in_start_frame(setup)), options_(options), start_(setup.start) {
  make_keeper(setup.start.mean);
  if (keeper_->window_factor() == nullptr) {
    if (options_.gate > 0.0) throw std::invalid_argument("gate needs mean_recovery: tree");
    if (options_.robust_above > 0.0) throw std::invalid_argument("robust_above needs mean_recovery: tree");
  } else {
    innovation_ = 0.0;
  }
  if (options_.first_estimates > 0) state_.first_estimates().settle_after(options_.first_estimates);
  if (tree_ == nullptr) return;
  relate_to_start(state_, start_.inner().covariance);
  tree_->hold(state_, std::array{0, 1}, start_point_sd);
}

void Seif::make_keeper(const Pose2& start) {
  switch (options_.mean_recovery) {
    case MeanRecovery::tree: {
      state_.keep_frozen_apart();
      auto keeper = std::make_unique<TreeMean>(options_.tree, start);
      tree_ = &keeper->tree();
      belief_ = std::make_unique<TreeBelief>(state_, *tree_, T_robot_sensor_, asked_);
      news_ = std::make_unique<TreeNews>(state_, *tree_);
      keeper_ = std::move(keeper);
      return;
    }
    case MeanRecovery::multilevel:
      keeper_ = std::make_unique<GroupMean>(options_.multilevel);
      return;
    case MeanRecovery::exact:
      keeper_ = std::make_unique<ExactMean>();
      return;
    case MeanRecovery::coordinate_descent:
      break;
  }
  throw std::invalid_argument("mean_recovery: tree, multilevel or exact");
}

void Seif::motion_update(const Odometry& odometry) {
  factor_is_current_ = false;
  if (tree_ != nullptr && odometry.covariance(2, 2) > most_heading_variance) tree_->keep_fixed();
  InformationFilter::motion_update(odometry);
}

void Seif::measurement_update(const Scan& scan, const StageDone& done) {
  factor_is_current_ = false;
  state_.begin_scan();
  activate_known(scan);
  if (!keeper_->before_information(state_)) throw NumericalFailure("mean recovery", scan.t);

  join_equal(scan.t);
  relocate(scan.t);
  linearise_known(state_, scan, T_robot_sensor_, options_.closing_gate, factors_);  // eqs. (15), (23)
  allow_for_curvature(scan);
  if (options_.gate > 0.0 || options_.robust_above > 0.0) check_innovations(scan.t);
  for (const ObservationFactor& factor : factors_) add(state_, factor);  // eqs. (21), (22)
  solve_window(scan.t);                                                  // eq. (37), for the window
  note_innovation();
  carry_closing(scan.t);
  relinearise(scan.t);

  if (!add_new(scan)) solve_window(scan.t);
  update_first_estimates(state_);
  if (!keeper_->after_information(state_)) throw NumericalFailure("mean recovery", scan.t);
  done(Stage::measurement);

  sparsify(scan.t);  // eqs. (48) to (51), by the gauge-free rule
  done(Stage::sparsification);

  if (!keeper_->end_update(state_)) throw NumericalFailure("mean recovery", scan.t);  // eq. (37)
  factor_is_current_ = true;
  done(Stage::mean_recovery);
}

/// Moves into the window: the known landmarks of the scan, and those that are to be joined because they are the
/// same.
void Seif::activate_known(const Scan& scan) {
  seen_.clear();
  double range = 0.0;
  double sighting_sd = 0.0;
  for (const Observation& observation : scan.observations) {
    range = std::max(range, observation.range);
    sighting_sd = std::max(sighting_sd, sd_of_sighting(observation));
    if (tree_ != nullptr && !can_turn(observation)) tree_->keep_fixed();
    if (const auto slot = state_.find(observation.landmark)) seen_.push_back(*slot);
  }
  if (sighting_sd > 0.0) state_.first_estimates().note_sighting_sd(sighting_sd);
  const auto see = [&](int slot) {
    if (std::ranges::find(seen_, slot) == seen_.end()) seen_.push_back(slot);
  };
  for (const auto& [a, b] : asked_.equal_slots) {
    see(a);
    see(b);
  }
  if (asked_.relocation) {
    for (const LandmarkId id : asked_.relocation->surroundings.landmarks) {
      if (const auto slot = state_.find(id)) see(*slot);
    }
  }
  if (!keeper_->activate(state_, seen_, range)) throw NumericalFailure("activation", scan.t);
  for (const int slot : seen_) state_.mark_seen(slot);
}

/// Called before the scan is taken in, so that the step of the mean does not count as an innovation of the
/// scan.
void Seif::join_equal(double t) {
  if (asked_.equal_slots.empty()) return;
  add_equal(state_, asked_.equal_slots);
  asked_.equal_slots.clear();
  solve_window(t);
}

/// The robot is put where its surroundings say, and those that are new join the map.
void Seif::relocate(double t) {
  if (!asked_.relocation) return;
  const Relocation& to = *asked_.relocation;
  if (!to.keeps_pose) {
    forget_pose(to.surroundings, t);
    put_robot(state_, to.T_world_robot);
  }
  for (std::size_t i = 0; i < to.surroundings.size(); ++i) {
    const LandmarkId id = to.surroundings.landmarks[i];
    if (state_.find(id)) continue;
    const int slot = state_.add_landmark(id, to.T_world_robot * to.surroundings.at(i));
    keeper_->join(state_, slot);
    state_.mark_seen(slot);
  }
  add_surroundings(state_, to);
  asked_.relocation.reset();
  ++relocations_;
  solve_window(t);
}

/// The landmarks of the old place are frozen, since nothing links them to the robot any more.
void Seif::forget_pose(const Surroundings& surroundings, double t) {
  if (!forget_robot(state_)) throw NumericalFailure("relocation", t);
  to_drop_.clear();
  for (int position = 0; position < state_.active_count(); ++position) {
    const int slot = state_.active(position);
    if (std::ranges::find(surroundings.landmarks, state_.id(slot)) == surroundings.landmarks.end())
      to_drop_.push_back(slot);
  }
  if (to_drop_.empty()) return;
  if (!freeze_dropped()) throw NumericalFailure("relocation", t);
}

/// Computes the noise of the linearisation if a rough guess says that it may matter. So the usual update pays
/// no more for it than the variance of the heading: one triangular system.
void Seif::allow_for_curvature(const Scan& scan) {
  is_curved_ = false;
  if (noise_factor() == 0.0 || factors_.empty()) return;
  const double times = noise_factor() / least_curvature;
  const double V = heading_variance(scan.t);
  is_curved_ = std::ranges::any_of(factors_, [&](const ObservationFactor& factor) {
    const Eigen::Vector2d rough = times * rough_linearisation_noise(factor, V);
    return (rough.array() > factor.observation.covariance.diagonal().array()).any();
  });
  if (!is_curved_) return;
  solve_window(scan.t);  // for its factor; r is already zero, so no mean moves
  for (ObservationFactor& factor : factors_) set_noise(factor, noise_of(factor));
}

/// Of the variances of the linearisation. [-] 0 where nothing knows the covariance of the window.
double Seif::noise_factor() const {
  const bool is_known = keeper_->window_factor() != nullptr;
  return is_known ? options_.linearisation_noise * options_.linearisation_noise : 0.0;
}

/// By the latest solution for the window. [rad^2]
double Seif::heading_variance(double t) {
  if (keeper_->window_factor()->size == 0) solve_window(t);
  return seif::heading_variance(*keeper_->window_factor(), columns_);
}

/// Given the latest solution for the window. [m^2, rad^2]
Eigen::Vector2d Seif::noise_of(const ObservationFactor& factor) {
  const WindowFactor& window = *keeper_->window_factor();
  if (factor.at_measurement && tree_ != nullptr &&
      tree_->turns()) {  // where the closure leads to: how far away that is does not count
    const double V = seif::heading_variance(window, columns_);
    return noise_factor() * linearisation_noise(factor.observation, V);
  }
  return noise_factor() * linearisation_noise(state_, factor, window, columns_);
}

/// Ignores the observations that fail the gate, and enlarges the covariance of those beyond robust_above. Each
/// is tested alone, before any observation of the scan is added.
void Seif::check_innovations(double t) {
  if (factors_.empty()) return;
  solve_window(t);  // for its factor; r is already zero, so no mean moves
  const WindowFactor& window = *keeper_->window_factor();
  std::size_t kept = 0;
  for (ObservationFactor& factor : factors_) {
    const double squared = squared_mahalanobis(factor, window);
    if (options_.gate > 0.0 && squared > options_.gate) {
      ++gated_;
      continue;
    }
    const double excess = huber_excess(squared, options_.robust_above);
    factor.observation.covariance *= excess;
    set_noise(factor, factor.noise);
    if (excess > 1.0) ++weakened_;
    factors_[kept++] = factor;
  }
  factors_.resize(kept);
}

/// v' S^-1 v with the innovation covariance S = J (L L')^-1 J' + Q.
double Seif::squared_mahalanobis(const ObservationFactor& factor, const WindowFactor& window) {
  const int w = state_.window_size();
  if (J_by_factor_.rows() < w) J_by_factor_.resize(2 * w, 2);
  auto Y = J_by_factor_.topRows(w);
  Y.setZero();
  Y.topRows<3>() = factor.J_x.transpose();
  Y.middleRows<2>(InformationState::row_of(state_.position(factor.slot))) = factor.J_m.transpose();
  window.L().triangularView<Eigen::Lower>().solveInPlace(Y);
  const Eigen::Matrix2d S = Y.transpose() * Y + covariance(factor);
  const Eigen::Vector2d v = residual(state_, factor);
  return v.dot(S.inverse() * v);
}

/// v' S^-1 v of all factors together, computed from the step that solve_window() has just made. Let d be the
/// step of all means and C the information before the scan. The least squared error of belief and scan is
///   d' C d + sum (v - J d)' Q^-1 (v - J d) = sum v' Q^-1 v - b' (C + sum J' Q^-1 J)^-1 b,  b = sum J' Q^-1 v,
/// and it equals v' S^-1 v with S = J C^-1 J' + Q. With the tree, r was zero before the scan, so b is r.
void Seif::note_innovation() {
  const WindowFactor* window = keeper_->window_factor();
  if (window == nullptr) return;
  double sum = 0.0;
  for (const ObservationFactor& factor : factors_) sum += squared_norm(factor.v, factor);
  innovation_ = std::max(0.0, sum - window->chi_square_drop);
  innovation_degrees_ = 2 * static_cast<int>(factors_.size());
}

/// Where a scan closes a loop, its Jacobians are those of the map after it, and what was known has those of the map
/// before it. The difference looks like an observation of the heading. So what was known is linearised anew where the
/// scan has moved it, and the scan is added again.
void Seif::carry_closing(double t) {
  if (tree_ == nullptr || !tree_->turns()) return;
  if (std::ranges::none_of(factors_, &ObservationFactor::at_measurement)) return;
  subtract_all(state_, factors_);
  if (!tree_->carry(state_)) throw NumericalFailure("carrying at a closure", t);
  add_again(state_, T_robot_sensor_, factors_);
  solve_window(t);
}

void Seif::relinearise(double t) {
  for (int round = 0; round < most_relinearisations; ++round) {
    if (!any_stale()) return;
    subtract_all(state_, factors_);
    follow_pose(state_, factors_.front().x0);
    for (std::size_t i = 0; i < factors_.size(); ++i) factors_[i].noise = again_[i].noise;
    add_again(state_, T_robot_sensor_, factors_);
    solve_window(t);
  }
}

/// Linearises the scan at the present mean, to again_, and compares.
bool Seif::any_stale() {
  again_.clear();
  bool any = false;
  for (const ObservationFactor& factor : factors_) {
    again_.push_back(linearise(state_, factor.slot, factor.observation, T_robot_sensor_));
    if (is_curved_) set_noise(again_.back(), noise_of(again_.back()));
    any = any || is_stale(state_, factor, again_.back(), options_.relinearise_above);
  }
  return any;
}

/// Adds the landmarks that were never seen before, placed from the pose that the other observations have
/// corrected. Their innovation is zero. Returns false if one of them was seen more than once: then its
/// innovation is not zero, and the window must be solved again.
bool Seif::add_new(const Scan& scan) {
  const int known = state_.landmark_count();
  bool seen_once = true;
  std::optional<double> V;
  for (const Observation& observation : scan.observations) {
    std::optional<int> slot = state_.find(observation.landmark);
    if (slot && *slot < known) continue;
    if (slot) {
      seen_once = false;
    } else {
      slot = state_.add_landmark(
          observation.landmark,
          invert_observation(state_.pose(), T_robot_sensor_, observation).p_world_landmark);
      keeper_->join(state_, *slot);
      state_.mark_seen(*slot);
    }
    ObservationFactor factor = linearise(state_, *slot, observation, T_robot_sensor_);
    if (noise_factor() > 0.0) {
      if (!V) V = heading_variance(scan.t);
      set_noise(factor, noise_factor() * linearisation_noise(observation, *V));
    }
    add(state_, factor);
  }
  return seen_once;
}

void Seif::solve_window(double t) {
  if (!keeper_->solve_window(state_)) throw NumericalFailure("local solve", t);
}

/// Drops the links in a burst: this costs less, and keeps more information, than enforcing the bound at each
/// update.
void Seif::sparsify(double t) {
  const int most = options_.theta_max + active_start_points(state_);  // theta_max is of landmarks
  choose_surplus(state_, {.theta_x = options_.theta_x, .theta_max = most}, to_drop_);
  if (to_drop_.empty()) return;
  const std::optional<double> anchoring = seif::sparsify(state_, SparsificationRule::gauge_free, to_drop_);
  if (!anchoring) throw NumericalFailure("sparsification", t);
  if (!freeze_dropped()) throw NumericalFailure("freezing", t);
  anchoring_ += *anchoring;
}

bool Seif::freeze_dropped() {
  if (state_.keeps_frozen_apart() && !freeze(state_, to_drop_, frozen_)) return false;
  if (tell_) tell_(frozen_);
  return keeper_->freeze(state_, frozen_);
}

/// (L L')^-1 in the rows of the pose, the first ones of the window.
std::optional<Eigen::Matrix3d> Seif::pose_covariance() const {
  const WindowFactor* window = keeper_->window_factor();
  if (window == nullptr || !factor_is_current_) return std::nullopt;
  if (columns_.rows() < window->size) columns_.resize(2 * window->size, 3);
  auto Y = columns_.topRows(window->size);
  Y.setZero();
  Y.topRows<3>().setIdentity();
  window->L().triangularView<Eigen::Lower>().solveInPlace(Y);
  return Eigen::Matrix3d(Y.transpose() * Y) + start_.of_pose(pose());
}

/// All information about [pose | slots in their order], what is frozen turned to where it is now. (3+2N x 3+2N),
/// lower triangle
Eigen::SparseMatrix<double> Seif::whole_information() const {
  if (tree_ == nullptr) return full_Omega(state_);
  std::vector<Eigen::Triplet<double>> entries = window_entries(state_);
  for (const FrozenInformation::Block& block : tree_->frozen_information(state_).blocks) {
    const bool is_lower = block.slot >= block.other;
    const int row = InformationState::row_of(is_lower ? block.slot : block.other);
    const int col = InformationState::row_of(is_lower ? block.other : block.slot);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < (row == col ? i + 1 : 2); ++j)
        entries.emplace_back(row + i, col + j, is_lower ? block.Omega(i, j) : block.Omega(j, i));
    }
  }
  const int size = InformationState::row_of(state_.landmark_count());
  Eigen::SparseMatrix<double> Omega(size, size);
  Omega.setFromTriplets(entries.begin(), entries.end());
  return Omega;
}

/// Without the start points, as if their places were known exactly.
Eigen::MatrixXd Seif::whole_belief_matrix() const {
  if (tree_ == nullptr) return InformationFilter::whole_belief_matrix();
  const Eigen::MatrixXd all = Eigen::MatrixXd(whole_information()).selfadjointView<Eigen::Lower>();
  constexpr Eigen::Index of_start_points = 2 * static_cast<Eigen::Index>(start_points.size());
  const Eigen::Index landmarks = all.rows() - 3 - of_start_points;
  Eigen::MatrixXd Omega(3 + landmarks, 3 + landmarks);
  Omega << all.topLeftCorner<3, 3>(), all.topRightCorner(3, landmarks), all.bottomLeftCorner(landmarks, 3),
      all.bottomRightCorner(landmarks, landmarks);
  return Omega;
}

std::optional<MarginalCovariances> Seif::marginal_covariances(std::span<const LandmarkId> landmarks) const {
  std::vector<int> rows;
  for (const LandmarkId landmark : landmarks)
    rows.push_back(InformationState::row_of(state_.find(landmark).value()));
  std::optional<MarginalCovariances> marginals = marginals_of(whole_information(), 0, rows);
  if (!marginals) return marginals;
  marginals->pose += start_.of_pose(pose());
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    marginals->landmarks[i] += start_.of_point(mean(state_.find(landmarks[i]).value()));
  return marginals;
}

std::optional<std::vector<Eigen::MatrixXd>> Seif::joint_covariances(
    std::span<const LandmarkIds> groups) const {
  const auto row_of = [&](LandmarkId id) { return InformationState::row_of(state_.find(id).value()); };
  std::vector<std::vector<int>> blocks;
  for (const LandmarkIds& group : groups) blocks.push_back(joint_rows(group, row_of));
  std::optional<std::vector<Eigen::MatrixXd>> joint = blocks_of_inverse(whole_information(), blocks);
  for (std::size_t g = 0; joint && g < groups.size(); ++g) {
    Eigen::VectorXd means(3 + 2 * static_cast<Eigen::Index>(groups[g].size()));
    means.head<3>() << pose().x, pose().y, pose().theta;
    Eigen::Index row = 3;
    for (const LandmarkId landmark : groups[g]) {
      means.segment<2>(row) = mean(state_.find(landmark).value());
      row += 2;
    }
    start_.add_to((*joint)[g], means);
  }
  return joint;
}

std::size_t Seif::memory_bytes() const { return state_.memory_bytes() + keeper_->memory_bytes(); }

bool Seif::change_option(std::string_view option, double value) {
  if (option == "theta_x" || option == "theta_max") {
    (option == "theta_x" ? options_.theta_x : options_.theta_max) = static_cast<int>(value);
    return true;
  }
  if (tree_ == nullptr || (option != "gate" && option != "robust_above")) return false;
  (option == "gate" ? options_.gate : options_.robust_above) = value;
  return true;
}

Counts Seif::counts() const {
  return without_start_points(state_, {.blocks_touched = state_.blocks_touched() + keeper_->blocks_touched(),
                                       .relocations = relocations_,
                                       .gated = gated_,
                                       .weakened = weakened_,
                                       .active_landmarks = state_.active_count(),
                                       .links = state_.link_count(),
                                       .mean_residual = keeper_->residual(),
                                       .anchoring = anchoring_,
                                       .innovation = innovation_,
                                       .innovation_degrees = innovation_degrees_});
}

}  // namespace seif
