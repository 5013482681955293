#include "seif/dense/eif.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>

#include "seif/couplings.hpp"
#include "seif/marginals.hpp"
#include "seif/models.hpp"

namespace seif {

Eif::Eif(const EstimatorSetup& setup) : T_robot_sensor_(setup.T_robot_sensor) {
  const Eigen::LLT<Eigen::Matrix3d> llt(setup.start.covariance);
  if (llt.info() != Eigen::Success) {
    throw std::invalid_argument("the covariance of the start estimate is not positive definite");
  }
  Omega_ = llt.solve(Eigen::Matrix3d::Identity());
  mu_ = Eigen::Vector3d(setup.start.mean.x, setup.start.mean.y, setup.start.mean.theta);
}

void Eif::motion_update(const Odometry& odometry) {
  const PredictedPose predicted = predict_pose(pose(), odometry);
  const Eigen::Matrix3d Psi = predicted.J_wrt_pose.inverse();
  const Eigen::Matrix3d& L = predicted.noise_factor;
  Omega_.leftCols<3>() = (Omega_.leftCols<3>() * Psi).eval();
  Omega_.topRows<3>() = (Psi.transpose() * Omega_.topRows<3>()).eval();
  const Eigen::Matrix<double, Eigen::Dynamic, 3> A = Omega_.leftCols<3>() * L;
  const Eigen::Matrix3d S = Eigen::Matrix3d::Identity() + L.transpose() * A.topRows<3>();
  Omega_ -= A * S.llt().solve(A.transpose());
  Omega_ = (0.5 * (Omega_ + Omega_.transpose())).eval();
  mu_.head<3>() << predicted.pose.x, predicted.pose.y, predicted.pose.theta;
  blocks_touched_ += std::int64_t(ids_.size() + 1) * std::int64_t(ids_.size() + 2) / 2;
}

/// The landmark's row in the state; one that is new joins the map with no information, where it was seen.
int Eif::row_of_landmark(const Observation& observation) {
  if (const auto slot = index_.find(observation.landmark)) return row_of(*slot);
  const auto row = static_cast<int>(mu_.size());
  index_.insert(observation.landmark, static_cast<int>(ids_.size()));
  ids_.push_back(observation.landmark);
  Omega_.conservativeResizeLike(Eigen::MatrixXd::Zero(row + 2, row + 2));
  mu_.conservativeResize(row + 2);
  mu_.tail<2>() = invert_observation(pose(), T_robot_sensor_, observation).p_world_landmark;
  return row;
}

void Eif::measurement_update(const Scan& scan, const StageDone& done) {
  for (const Observation& observation : scan.observations) row_of_landmark(observation);
  Eigen::VectorXd r = Eigen::VectorXd::Zero(mu_.size());  // xi - Omega mu
  for (const Observation& observation : scan.observations) {
    const int row = row_of_landmark(observation);
    const PredictedObservation predicted = predict_observation(pose(), T_robot_sensor_, mu_.segment<2>(row));
    const Eigen::Matrix2d Q_inverse = observation.covariance.inverse();
    const Eigen::Vector2d v = innovation(observation, predicted.z);
    const Matrix23& C_x = predicted.J_wrt_pose;  // the report's C is the transpose
    const Eigen::Matrix2d& C_m = predicted.J_wrt_landmark;
    const Eigen::Matrix<double, 3, 2> Omega_xm = C_x.transpose() * Q_inverse * C_m;
    Omega_.topLeftCorner<3, 3>() += C_x.transpose() * Q_inverse * C_x;
    Omega_.block<3, 2>(0, row) += Omega_xm;
    Omega_.block<2, 3>(row, 0) += Omega_xm.transpose();
    Omega_.block<2, 2>(row, row) += C_m.transpose() * Q_inverse * C_m;
    r.head<3>() += C_x.transpose() * Q_inverse * v;
    r.segment<2>(row) += C_m.transpose() * Q_inverse * v;
  }
  blocks_touched_ += 3 * std::int64_t(scan.observations.size());
  done(Stage::measurement);

  const Eigen::LLT<Eigen::MatrixXd> llt(Omega_);
  if (llt.info() != Eigen::Success) throw NumericalFailure("mean recovery", scan.t);
  mu_ += llt.solve(r);
  mu_(2) = wrap_angle(mu_(2));
  blocks_touched_ += std::int64_t(ids_.size() + 1) * std::int64_t(ids_.size() + 2) / 2;
  done(Stage::mean_recovery);
}

Counts Eif::counts() const {
  Counts counts{.blocks_touched = blocks_touched_, .active_landmarks = 0, .links = 0};
  for (int i = 0; i < static_cast<int>(ids_.size()); ++i) {
    if (!Omega_.block<2, 3>(row_of(i), 0).isZero(0.0)) ++counts.active_landmarks;
    for (int j = 0; j < i; ++j) {
      if (!Omega_.block<2, 2>(row_of(i), row_of(j)).isZero(0.0)) ++counts.links;
    }
  }
  counts.links += counts.active_landmarks;
  return counts;
}

std::size_t Eif::memory_bytes() const {
  return static_cast<std::size_t>(Omega_.size() + mu_.size()) * sizeof(double) +
         ids_.capacity() * sizeof(LandmarkId) + index_.memory_bytes();
}

void Eif::landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const {
  out.clear();
  for (const LandmarkId landmark : landmarks) {
    if (const auto slot = index_.find(landmark)) out.push_back({landmark, mu_.segment<2>(row_of(*slot))});
  }
}

void Eif::couplings(LandmarkId of, std::vector<Coupling>& out) const {
  couplings_of(Omega_, index_, ids_, of, out);
}

std::vector<LandmarkEstimate> Eif::map() const {
  std::vector<LandmarkEstimate> map;
  for (int slot = 0; slot < static_cast<int>(ids_.size()); ++slot) {
    map.push_back({ids_[static_cast<std::size_t>(slot)], mu_.segment<2>(row_of(slot))});
  }
  return map;
}

std::optional<Eigen::MatrixXd> Eif::Sigma() const {
  const Eigen::LLT<Eigen::MatrixXd> llt(Omega_);
  if (llt.info() != Eigen::Success) return std::nullopt;
  return llt.solve(Eigen::MatrixXd::Identity(Omega_.rows(), Omega_.cols()));
}

std::optional<MarginalCovariances> Eif::marginal_covariances(std::span<const LandmarkId> landmarks) const {
  const std::optional<Eigen::MatrixXd> Sigma = this->Sigma();
  if (!Sigma) return std::nullopt;
  MarginalCovariances marginals{.pose = Sigma->topLeftCorner<3, 3>(), .landmarks = {}};
  for (const LandmarkId landmark : landmarks) {
    const int row = row_of(index_.find(landmark).value());
    marginals.landmarks.emplace_back(Sigma->block<2, 2>(row, row));
  }
  return marginals;
}

std::optional<std::vector<Eigen::MatrixXd>> Eif::joint_covariances(
    std::span<const LandmarkIds> groups) const {
  const std::optional<Eigen::MatrixXd> Sigma = this->Sigma();
  if (!Sigma) return std::nullopt;
  std::vector<Eigen::MatrixXd> joint;
  for (const LandmarkIds& group : groups) {
    const std::vector<int> rows =
        joint_rows(group, [&](LandmarkId id) { return row_of(index_.find(id).value()); });
    joint.emplace_back((*Sigma)(rows, rows));
  }
  return joint;
}

}  // namespace seif
