// How the steps that BodyFit finds go with the places of its points: what is known of a part in its own frame becomes
// what it says of where its landmarks are now.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/tree/body_motion.hpp"

namespace seif {

/// T = d step / d places = D + U C': D turns the rows of each point, and k columns of C tell how whole, clusters and
/// their middles turn and move with the points. A part with the information S and the residual r in its own frame has
/// T' S T and T' r where it is: they say nothing of a motion of the whole, and of one of a cluster just what S said.
class StepJacobian {
 public:
  /// Point i has the rows from rows[i] on, of `size`: two, and a third one if it is turned.
  void of(const BodyFit& fit, std::span<const int> rows, Eigen::Index size);

  void bring(Eigen::Ref<Eigen::MatrixXd> S);
  /// Reads and writes the lower triangle of S. What stands above it is lost.
  void bring_lower(Eigen::Ref<Eigen::MatrixXd> S);
  void bring_residual(Eigen::Ref<Eigen::VectorXd> r);

 private:
  void begin(Eigen::Index size, Eigen::Index columns);
  void set_whole(const BodyFit& fit);
  void set_clusters(const BodyFit& fit);
  void turn_lower(Eigen::Ref<Eigen::MatrixXd> S) const;
  void turn_pairs(double* column, Eigen::Index first) const;
  auto U() const { return U_.topLeftCorner(size_, k_); }
  auto C() const { return C_.topLeftCorner(size_, k_); }

  std::span<const int> rows_;
  Eigen::Index size_ = 0, k_ = 0;
  std::vector<Eigen::Matrix2d> D_;       // by point
  std::vector<Eigen::Index> column_of_;  // the first one of each cluster
  Eigen::MatrixXd U_, C_, B_;            // (size x k), with room to grow
  Eigen::MatrixXd half_;                 // scratch (k x k), with room to grow
};

}  // namespace seif
