// The dense matrix of any filter of the library, as a reference for the filter's own answers.
#pragma once

#include <vector>

#include "dense_oracle.hpp"
#include "seif/dense/eif.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/eseif.hpp"
#include "seif/full_state.hpp"
#include "seif/plain_seif.hpp"
#include "seif/seif.hpp"
#include "seif/start_frame.hpp"

namespace seif::test {

/// The whole matrix that a filter keeps: Sigma of an `ekf`, Omega of any other.
inline Eigen::MatrixXd matrix_of(const Estimator& filter) {
  if (const auto* seif = dynamic_cast<const Seif*>(&filter)) return seif->whole_belief_matrix();
  if (const auto* report = dynamic_cast<const PlainSeif*>(&filter)) {
    return oracle::symmetric(full_Omega(report->state()));
  }
  if (const auto* eseif = dynamic_cast<const Eseif*>(&filter)) {
    return oracle::symmetric(full_Omega(eseif->state()));
  }
  if (const auto* eif = dynamic_cast<const Eif*>(&filter)) return eif->Omega();
  return dynamic_cast<const Ekf&>(filter).Sigma();
}

/// The covariance of [x y theta | the landmarks of map()] by that matrix. `seif` leaves the uncertainty of the
/// start out of its matrix: here it is added, as one rigid motion of robot and map.
inline Eigen::MatrixXd covariance_of(const Estimator& filter, const PoseEstimate& begin) {
  const Eigen::MatrixXd M = matrix_of(filter);
  if (filter.belief_matrix() == BeliefMatrix::covariance) return M;
  Eigen::MatrixXd Sigma = oracle::inverse(M);
  if (dynamic_cast<const Seif*>(&filter) == nullptr) return Sigma;
  const std::vector<LandmarkEstimate> map = filter.map();
  Eigen::MatrixXd moved(Sigma.rows(), 3);  // by the start
  const auto fill = [&](Eigen::Index row, double x, double y) {
    moved.middleRows<2>(row) << 1.0, 0.0, begin.mean.y - y, 0.0, 1.0, x - begin.mean.x;
  };
  fill(0, filter.pose().x, filter.pose().y);
  moved.row(2) << 0.0, 0.0, 1.0;
  Eigen::Index row = 3;
  for (const LandmarkEstimate& estimate : map) {
    fill(row, estimate.mean.x(), estimate.mean.y());
    row += 2;
  }
  const Eigen::Matrix3d outer = begin.covariance - StartFrame(begin).inner().covariance;
  return Sigma + moved * outer * moved.transpose();
}

}  // namespace seif::test
