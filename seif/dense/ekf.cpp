#include "seif/dense/ekf.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "seif/couplings.hpp"
#include "seif/marginals.hpp"
#include "seif/models.hpp"

namespace seif {

Ekf::Ekf(const EstimatorSetup& setup, const EkfOptions& options)
    : T_robot_sensor_(setup.T_robot_sensor), options_(options) {
  if (setup.start.covariance.llt().info() != Eigen::Success) {
    throw std::invalid_argument("the covariance of the start estimate is not positive definite");
  }
  reserve(64);
  set_pose(setup.start.mean);
  Sigma_.topLeftCorner<3, 3>() = setup.start.covariance;
}

Pose2 Ekf::pose() const { return {mu_(0), mu_(1), mu_(2)}; }

void Ekf::set_pose(const Pose2& pose) { mu_.head<3>() << pose.x, pose.y, pose.theta; }

void Ekf::motion_update(const Odometry& odometry) {
  const PredictedPose predicted = predict_pose(pose(), odometry);
  const Eigen::Matrix3d& F = predicted.J_wrt_pose;
  const Eigen::Matrix3d Sigma_xx = Sigma_.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  Sigma_.topLeftCorner<3, 3>() =
      F * Sigma_xx * F.transpose() + predicted.noise_factor * predicted.noise_factor.transpose();
  auto Sigma_mx = Sigma_.block(3, 0, size() - 3, 3);
  Sigma_mx.col(0) += F(0, 2) * Sigma_mx.col(2);  // F differs from the identity in two entries
  Sigma_mx.col(1) += F(1, 2) * Sigma_mx.col(2);
  set_pose(predicted.pose);
  blocks_touched_ += landmark_count() + 1;
}

void Ekf::measurement_update(const Scan& scan, const StageDone& done) {
  if (!update_equal()) throw NumericalFailure("merging", scan.t);
  if (relocation_ && !update_relocation()) throw NumericalFailure("relocation", scan.t);
  pending_.clear();
  innovation_ = 0.0;
  innovation_degrees_ = 0;
  for (const Observation& observation : scan.observations) pending_.push_back(&observation);
  while (!pending_.empty()) {  // once more only if a new landmark was seen twice
    known_.clear();
    unknown_.clear();
    std::size_t again = 0;
    for (const Observation* observation : pending_) {
      if (const auto slot = index_.find(observation->landmark)) {
        const int row = row_of(*slot);
        const PredictedObservation predicted =
            predict_observation(pose(), T_robot_sensor_, mu_.segment<2>(row));
        Linearised linearised{
            .row = row, .v = innovation(*observation, predicted.z), .J = {}, .Q = observation->covariance};
        linearised.J << predicted.J_wrt_pose, predicted.J_wrt_landmark;
        if (admit(linearised)) known_.push_back(linearised);
      } else if (std::ranges::find(unknown_, observation->landmark, &Observation::landmark) ==
                 unknown_.end()) {
        unknown_.push_back(observation);
      } else {
        pending_[again++] = observation;
      }
    }
    pending_.resize(again);
    if (!known_.empty() && !update_known()) throw NumericalFailure("measurement update", scan.t);
    for (const Observation* observation : unknown_) add_landmark(*observation);
  }
  done(Stage::measurement);
}

/// v' S^-1 v of it alone.
double Ekf::squared_mahalanobis(const Linearised& linearised) const {
  Eigen::Matrix<double, 5, 5> P = Eigen::Matrix<double, 5, 5>::Zero();  // lower triangle
  P.topLeftCorner<3, 3>() = Sigma_.topLeftCorner<3, 3>();
  P.bottomLeftCorner<2, 3>() = Sigma_.block<2, 3>(linearised.row, 0);
  P.bottomRightCorner<2, 2>() = Sigma_.block<2, 2>(linearised.row, linearised.row);
  const Eigen::Matrix2d S =
      linearised.J * P.selfadjointView<Eigen::Lower>() * linearised.J.transpose() + linearised.Q;
  return linearised.v.dot(S.inverse() * linearised.v);
}

/// False if what was seen is too far from what was expected; what is far from it, but not so far, is
/// weakened. Counts both.
bool Ekf::admit(Linearised& linearised) {
  if (options_.gate <= 0.0 && options_.robust_above <= 0.0) return true;
  const double squared = squared_mahalanobis(linearised);
  if (options_.gate > 0.0 && squared > options_.gate) {
    ++gated_;
    return false;
  }
  const double times = huber_excess(squared, options_.robust_above);
  linearised.Q *= times;
  if (times > 1.0) ++weakened_;
  return true;
}

/// Copies the full columns [row, row + Width) of Sigma to columns_ from column `to`; what lies above the
/// diagonal stands in the rows.
template <int Width>
void Ekf::gather_columns(int row, int to) {
  const int below = row + Width;
  auto column = columns_.middleCols<Width>(to);
  column.topRows(row) = Sigma_.block(row, 0, Width, row).transpose();
  column.template middleRows<Width>(row) =
      Sigma_.block<Width, Width>(row, row).template selfadjointView<Eigen::Lower>();
  column.middleRows(below, size() - below) = Sigma_.block(below, row, size() - below, Width);
}

/// One Kalman update with all observations in known_. With W = Sigma C and S = C' W + Q = L L':
/// mu += (W L^-T) L^-1 v, Sigma -= (W L^-T)(W L^-T)'. False if S is not positive definite.
bool Ekf::update_known() {
  const auto k = static_cast<int>(known_.size());
  const int n = size();
  if (W_.rows() < n || W_.cols() < 2 * k) W_.resize(Sigma_.rows(), std::max<Eigen::Index>(2 * k, W_.cols()));
  auto W = W_.topLeftCorner(n, 2 * k);
  v_.resize(2 * k);
  gather_columns<3>(0, 0);
  for (int i = 0; i < k; ++i) {
    const Linearised& known = known_[static_cast<std::size_t>(i)];
    gather_columns<2>(known.row, 3);
    W.middleCols<2>(2 * i).noalias() = columns_.topRows(n) * known.J.transpose();
    v_.segment<2>(2 * i) = known.v;
  }
  S_.resize(2 * k, 2 * k);
  for (int i = 0; i < k; ++i) {
    const Linearised& known = known_[static_cast<std::size_t>(i)];
    S_.middleRows<2>(2 * i).noalias() =
        known.J.leftCols<3>() * W.topRows<3>() + known.J.rightCols<2>() * W.middleRows<2>(known.row);
    S_.block<2, 2>(2 * i, 2 * i) += known.Q;
  }
  if (!apply_gain(2 * k)) return false;
  innovation_ += v_.squaredNorm();
  innovation_degrees_ += 2 * k;
  return true;
}

/// Of `observed` quantities with W_ = Sigma C, S_ and v_, which becomes L^-1 v.
bool Ekf::apply_gain(int observed) {
  const int n = size();
  auto W = W_.topLeftCorner(n, observed);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(S_);
  if (llt.info() != Eigen::Success) return false;
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(W);
  llt.matrixL().solveInPlace(v_);
  mu_.head(n).noalias() += W * v_;
  mu_(2) = wrap_angle(mu_(2));
  downdate_(Sigma_, W);
  blocks_touched_ += std::int64_t{landmark_count() + 1} * (landmark_count() + 2) / 2;
  return true;
}

/// m_a - m_b = 0, as if it had been observed.
bool Ekf::update_equal() {
  for (const auto& [a, b] : equal_) {
    const int n = size();
    const int row_a = row_of(index_.find(a).value());
    const int row_b = row_of(index_.find(b).value());
    if (W_.rows() < n || W_.cols() < 2) W_.resize(Sigma_.rows(), std::max<Eigen::Index>(2, W_.cols()));
    auto W = W_.topLeftCorner(n, 2);
    gather_columns<2>(row_a, 3);
    W = columns_.topRows(n).rightCols<2>();
    gather_columns<2>(row_b, 3);
    W -= columns_.topRows(n).rightCols<2>();
    S_.resize(2, 2);
    S_ = W.middleRows<2>(row_a) - W.middleRows<2>(row_b);
    S_.diagonal().array() += equal_sd * equal_sd;
    v_.resize(2);
    v_ = mu_.segment<2>(row_b) - mu_.segment<2>(row_a);
    if (!apply_gain(2)) return false;
  }
  equal_.clear();
  return true;
}

/// The surroundings as one observation of all their landmarks. Nothing is known beforehand of those that are new, nor of
/// the pose, unless it is kept.
bool Ekf::update_relocation() {
  const Relocation to = *std::exchange(relocation_, std::nullopt);
  const int known = size();
  std::vector<int> flat;
  if (!to.keeps_pose) {
    set_pose(to.T_world_robot);
    Sigma_.topLeftCorner(known, 3).setZero();
    flat = {0, 1, 2};
  }
  for (std::size_t i = 0; i < to.surroundings.size(); ++i) {
    if (!index_.find(to.surroundings.landmarks[i]))
      append(to.surroundings.landmarks[i], to.T_world_robot * to.surroundings.at(i));
  }
  Sigma_.block(known, 0, size() - known, size()).setZero();
  for (int row = known; row < size(); ++row) flat.push_back(row);

  const auto q = static_cast<Eigen::Index>(2 * to.surroundings.size());
  Eigen::MatrixXd Sigma_J(size(), q);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(q, size());
  Eigen::VectorXd v(q);
  gather_columns<3>(0, 0);
  for (Eigen::Index at = 0; at < q; at += 2) {
    const auto i = static_cast<std::size_t>(at / 2);
    const int row = row_of(index_.find(to.surroundings.landmarks[i]).value());
    const ExpectedPlace expected = expect_place(pose(), mu_.segment<2>(row));
    gather_columns<2>(row, 3);
    J.block<2, 3>(at, 0) = expected.J_x;
    J.block<2, 2>(at, row) = expected.J_m;
    Sigma_J.middleCols<2>(at) =
        columns_.topRows(size()) * J(Eigen::seqN(at, 2), {0, 1, 2, row, row + 1}).transpose();
    v.segment<2>(at) = to.surroundings.at(i) - expected.p_robot;
  }
  const auto update =
      update_with_flat_prior(std::move(Sigma_J), J, to.surroundings.covariance, std::move(v), flat);
  if (!update) return false;
  apply(*update, flat);
  ++relocations_;
  return true;
}

void Ekf::apply(const FlatPriorUpdate& update, std::span<const int> flat) {
  const int n = size();
  mu_.head(n) += update.step;
  downdate_(Sigma_, update.W);
  const auto f = static_cast<Eigen::Index>(flat.size());
  for (Eigen::Index a = 0; a < f; ++a) {
    const int row = flat[static_cast<std::size_t>(a)];
    mu_(row) += update.step_f(a);
    for (int j = 0; j < n; ++j) Sigma_(std::max(row, j), std::min(row, j)) = update.cross(a, j);
  }
  for (Eigen::Index a = 0; a < f; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b)
      Sigma_(flat[static_cast<std::size_t>(a)], flat[static_cast<std::size_t>(b)]) = update.P(a, b);
  }
  mu_(2) = wrap_angle(mu_(2));
  blocks_touched_ += std::int64_t{landmark_count() + 1} * (landmark_count() + 2) / 2;
}

void Ekf::equate(LandmarkId a, LandmarkId b) { equal_.emplace_back(a, b); }

Eigen::Vector2d Ekf::mean_of(LandmarkId landmark) const {
  return mu_.segment<2>(row_of(index_.find(landmark).value()));
}

ExpectedObservation Ekf::expect(LandmarkId landmark, const Observation& observation) const {
  const PredictedObservation predicted = predict_observation(pose(), T_robot_sensor_, mean_of(landmark));
  return {innovation(observation, predicted.z), predicted.J_wrt_pose, predicted.J_wrt_landmark};
}

void Ekf::covariance_with(std::span<const LandmarkId> landmarks, Eigen::Ref<Eigen::MatrixXd> out) const {
  out.topLeftCorner<3, 3>() = *pose_covariance();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const int row = row_of(index_.find(landmarks[i]).value());
    const auto to = static_cast<Eigen::Index>(3 + 2 * i);
    out.block<2, 3>(to, 0) = Sigma_.block<2, 3>(row, 0);
    out.block<3, 2>(0, to) = out.block<2, 3>(to, 0).transpose();
    out.block<2, 2>(to, to) = Sigma_.block<2, 2>(row, row).selfadjointView<Eigen::Lower>();
    for (std::size_t j = 0; j < i; ++j) {
      const int other = row_of(index_.find(landmarks[j]).value());
      const auto col = static_cast<Eigen::Index>(3 + 2 * j);
      const Eigen::Matrix2d block = row > other ? Eigen::Matrix2d(Sigma_.block<2, 2>(row, other))
                                                : Eigen::Matrix2d(Sigma_.block<2, 2>(other, row).transpose());
      out.block<2, 2>(to, col) = block;
      out.block<2, 2>(col, to) = block.transpose();
    }
  }
}

/// Sigma grows by G Sigma_x., with G the Jacobian of the inverse observation.
void Ekf::add_landmark(const Observation& observation) {
  const InverseObservation inverse = invert_observation(pose(), T_robot_sensor_, observation);
  const int row = size();
  const int slot = landmark_count();
  reserve(slot + 1);
  gather_columns<3>(0, 0);
  Sigma_.block(row, 0, 2, row).noalias() =
      inverse.J_wrt_pose * columns_.topRows(row).leftCols<3>().transpose();
  Sigma_.block<2, 2>(row, row) =
      inverse.J_wrt_pose * columns_.topLeftCorner<3, 3>() * inverse.J_wrt_pose.transpose() +
      inverse.J_wrt_observation * observation.covariance * inverse.J_wrt_observation.transpose();
  append(observation.landmark, inverse.p_world_landmark);
  blocks_touched_ += slot + 2;
}

/// Its rows of Sigma are the caller's.
void Ekf::append(LandmarkId landmark, const Eigen::Vector2d& mean) {
  const int slot = landmark_count();
  reserve(slot + 1);
  mu_.segment<2>(row_of(slot)) = mean;
  ids_.push_back(landmark);
  index_.insert(landmark, slot);
}

void Ekf::reserve(int landmarks) {
  if (row_of(landmarks) <= mu_.size()) return;
  const int room = std::max(landmarks, landmark_count() + landmark_count() / 2);
  constexpr int tile = SymmetricDowndate::tile;
  const int rows = (row_of(room) + tile - 1) / tile * tile;
  mu_.conservativeResize(rows);
  Sigma_.conservativeResizeLike(Eigen::MatrixXd::Zero(rows, rows));
  columns_.resize(rows, 5);
}

bool Ekf::change_option(std::string_view option, double value) {
  if (option != "gate" && option != "robust_above") return false;
  (option == "gate" ? options_.gate : options_.robust_above) = value;
  return true;
}

Counts Ekf::counts() const {
  const std::int64_t n = landmark_count();
  return {.blocks_touched = blocks_touched_,
          .relocations = relocations_,
          .gated = gated_,
          .weakened = weakened_,
          .active_landmarks = landmark_count(),
          .links = n * (n + 1) / 2,
          .innovation = innovation_,
          .innovation_degrees = innovation_degrees_};
}

std::optional<Eigen::Matrix3d> Ekf::pose_covariance() const {
  return Eigen::Matrix3d(Sigma_.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>());
}

std::size_t Ekf::memory_bytes() const {
  const auto doubles = mu_.size() + Sigma_.size() + columns_.size() + W_.size() + S_.size() + v_.size();
  return static_cast<std::size_t>(doubles) * sizeof(double) + ids_.capacity() * sizeof(LandmarkId) +
         index_.memory_bytes();
}

void Ekf::landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const {
  out.clear();
  for (const LandmarkId landmark : landmarks) {
    if (const auto slot = index_.find(landmark)) out.push_back({landmark, mu_.segment<2>(row_of(*slot))});
  }
}

void Ekf::couplings(LandmarkId of, std::vector<Coupling>& out) const {
  couplings_of(Sigma_.topLeftCorner(size(), size()), index_, ids_, of, out);
}

std::vector<LandmarkEstimate> Ekf::map() const {
  std::vector<LandmarkEstimate> map;
  map.reserve(ids_.size());
  for (int slot = 0; slot < landmark_count(); ++slot) {
    map.push_back({ids_[static_cast<std::size_t>(slot)], mu_.segment<2>(row_of(slot))});
  }
  return map;
}

std::optional<MarginalCovariances> Ekf::marginal_covariances(std::span<const LandmarkId> landmarks) const {
  MarginalCovariances marginals;
  marginals.pose = *pose_covariance();
  marginals.landmarks.reserve(landmarks.size());
  for (const LandmarkId landmark : landmarks) {
    const int row = row_of(index_.find(landmark).value());
    marginals.landmarks.emplace_back(Sigma_.block<2, 2>(row, row).selfadjointView<Eigen::Lower>());
  }
  return marginals;
}

std::optional<std::vector<Eigen::MatrixXd>> Ekf::joint_covariances(
    std::span<const LandmarkIds> groups) const {
  std::vector<Eigen::MatrixXd> joint;
  joint.reserve(groups.size());
  for (const LandmarkIds& group : groups) {
    const std::vector<int> rows =
        joint_rows(group, [&](LandmarkId id) { return row_of(index_.find(id).value()); });
    const auto size = static_cast<Eigen::Index>(rows.size());
    joint.push_back(Eigen::MatrixXd::NullaryExpr(size, size, [&](Eigen::Index i, Eigen::Index j) {
      const auto [low, high] =
          std::minmax(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
      return Sigma_(high, low);
    }));
  }
  return joint;
}

Eigen::MatrixXd Ekf::Sigma() const {
  return Sigma_.topLeftCorner(size(), size()).selfadjointView<Eigen::Lower>();
}

}  // namespace seif
