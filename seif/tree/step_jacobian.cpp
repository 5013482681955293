#include "seif/tree/step_jacobian.hpp"

#include <algorithm>
#include <cmath>

#include "seif/packed_triangle.hpp"

namespace seif {
namespace {

constexpr Eigen::Index columns_of_cluster = 3;  // its turn, and where its middle goes

Eigen::Vector2d turned(const Eigen::Vector2d& p) { return {-p.y(), p.x()}; }

}  // namespace

void StepJacobian::begin(Eigen::Index size, Eigen::Index columns) {
  size_ = size;
  k_ = columns;
  if (U_.rows() < size || U_.cols() < columns) {
    const Eigen::Index rows = std::max(2 * size, U_.rows());
    const Eigen::Index cols = std::max(2 * columns, U_.cols());
    for (Eigen::MatrixXd* M : {&U_, &C_, &B_}) M->resize(rows, cols);
    half_.resize(cols, cols);
  }
  U_.topLeftCorner(size, columns).setZero();
  C_.topLeftCorner(size, columns).setZero();
}

void StepJacobian::of(const BodyFit& fit, std::span<const int> rows, Eigen::Index size) {
  rows_ = rows;
  column_of_.clear();
  Eigen::Index columns = 1;
  for (const BodyFit::Cluster& cluster : fit.clusters()) {
    column_of_.push_back(columns);
    if (fit.is_by_clusters() && cluster.turn.is_known()) columns += columns_of_cluster;
  }
  begin(size, columns);
  D_.clear();
  for (const BodyFit::Point& point : fit.points()) {
    const BodyFit::Cluster* const cluster = fit.cluster_of(point);
    D_.push_back((cluster != nullptr ? cluster->motion : fit.motion()).R.transpose());
  }
  set_whole(fit);
  set_clusters(fit);
}

/// The first column: by the turn of the whole.
void StepJacobian::set_whole(const BodyFit& fit) {
  const BodyMotion& whole = fit.motion();
  double scale = 0.0;
  for (std::size_t i = 0; i < fit.points().size(); ++i) {
    const BodyFit::Point& point = fit.points()[i];
    const BodyFit::Cluster* const cluster = fit.cluster_of(point);
    const Eigen::Index row = rows_[i];
    const bool is_turned = point.cluster == BodyFit::none;
    Eigen::Vector2d lever =
        whole.R.transpose() * ((cluster != nullptr ? cluster->motion.now : point.now) - whole.now);
    if (cluster != nullptr) lever += point.before - cluster->motion.before;
    U_.block<2, 1>(row, 0) = -turned(lever);
    if (is_turned) {
      U_(row + 2, 0) = -1.0;
      C_(row + 2, 0) = BodyFit::weight_of_turn;
      scale += BodyFit::weight_of_turn;
    }
    const BodyMotion* const fitted =
        fit.is_by_clusters() ? (cluster != nullptr ? &cluster->motion : nullptr) : &whole;
    if (fitted == nullptr) continue;
    const Eigen::Vector2d before = whole.R * (point.before - fitted->before);
    C_.block<2, 1>(row, 0) = turned(before);
    scale += before.dot(point.now - fitted->now);
  }
  if (scale != 0.0) C_.col(0).head(size_) /= scale;
}

/// Those of each cluster: by its turn and by where its middle goes.
void StepJacobian::set_clusters(const BodyFit& fit) {
  const Eigen::Matrix2d of_whole = fit.motion().R.transpose();
  for (std::size_t i = 0; i < fit.points().size(); ++i) {
    const BodyFit::Point& point = fit.points()[i];
    const BodyFit::Cluster* const cluster = fit.cluster_of(point);
    if (cluster == nullptr) continue;
    const Eigen::Index row = rows_[i];
    const Eigen::Index col = column_of_[static_cast<std::size_t>(point.cluster)];
    const BodyMotion& motion = cluster->motion;
    const Eigen::Vector2d before = point.before - motion.before;
    U_.block<2, 1>(row, col) = turned(before - motion.R.transpose() * (point.now - motion.now));
    U_.block<2, 2>(row, col + 1) = of_whole - motion.R.transpose();
    C_.block<2, 1>(row, col) = turned(motion.R * before) / std::hypot(cluster->turn.dot, cluster->turn.cross);
    C_.block<2, 2>(row, col + 1) = Eigen::Matrix2d::Identity() / cluster->points;
  }
}

void StepJacobian::bring(Eigen::Ref<Eigen::MatrixXd> S) {
  bring_lower(S);
  fill_upper_triangle(S);
}

/// (D + U C')' S (D + U C') = D' S D + B C' + C B', with B = D' S U + C U' S U / 2.
void StepJacobian::bring_lower(Eigen::Ref<Eigen::MatrixXd> S) {
  auto B = B_.topLeftCorner(size_, k_);
  for (Eigen::Index k = 0; k < k_; ++k) B.col(k).noalias() = S.selfadjointView<Eigen::Lower>() * U().col(k);
  auto half = half_.topLeftCorner(k_, k_);
  half.noalias() = 0.5 * (U().transpose() * B);
  for (Eigen::Index k = 0; k < k_; ++k) turn_pairs(B.col(k).data(), 0);
  B.noalias() += C() * half;
  turn_lower(S);
  for (Eigen::Index k = 0; k < k_; ++k) S.selfadjointView<Eigen::Lower>().rankUpdate(B.col(k), C().col(k));
}

/// D' S D.
void StepJacobian::turn_lower(Eigen::Ref<Eigen::MatrixXd> S) const {
  for (std::size_t i = 0; i < D_.size(); ++i) {
    const Eigen::Index col = rows_[i];
    S(col, col + 1) = S(col + 1, col);
    auto pair = S.block(col, col, size_ - col, 2);
    for (Eigen::Index k = 0; k < pair.rows(); ++k) pair.row(k) = (pair.row(k) * D_[i]).eval();
  }
  for (Eigen::Index col = 0; col < size_; ++col) turn_pairs(&S(0, col), col);
}

/// D' times a column, for all points whose second row is `first` or a later one.
void StepJacobian::turn_pairs(double* column, Eigen::Index first) const {
  for (std::size_t i = D_.size(); i-- > 0 && rows_[i] + 1 >= first;) {
    double* const pair = column + rows_[i];
    const Eigen::Matrix2d& D = D_[i];
    const double x = pair[0];
    pair[0] = D(0, 0) * x + D(1, 0) * pair[1];
    pair[1] = D(0, 1) * x + D(1, 1) * pair[1];
  }
}

void StepJacobian::bring_residual(Eigen::Ref<Eigen::VectorXd> r) {
  auto along = half_.col(0).head(k_);
  along.noalias() = U().transpose() * r;
  for (std::size_t i = 0; i < D_.size(); ++i)
    r.segment<2>(rows_[i]) = (D_[i].transpose() * r.segment<2>(rows_[i])).eval();
  r.noalias() += C() * along;
}

}  // namespace seif
