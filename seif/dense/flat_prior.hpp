// A Kalman update in which nothing is known beforehand of some of the unknowns.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace seif {

/// What an observation z = h(y) of covariance C says if the prior of the unknowns f among y becomes infinitely wide. With
/// S = J Sigma J' + C = L L', Sigma zero in the rows of f, and L^-1 J_f = [Q_1 Q_2] [R; 0]:
///   mu += W W' J' S^-1 v and so on, for all but f, with W = Sigma J' L^-T Q_2;
///   f += G L^-1 v with G = R^-1 Q_1', of covariance R^-1 R^-T, and of covariance -G L^-1 J Sigma with the others.
struct FlatPriorUpdate {
  Eigen::VectorXd step;    // of all but f (n x 1), zero for f
  Eigen::MatrixXd W;       // (n x q - f) Sigma -= W W'
  Eigen::VectorXd step_f;  // (f x 1)
  Eigen::MatrixXd P;       // (f x f) the covariance of f
  Eigen::MatrixXd cross;   // (f x n) and with the others
};

/// `Sigma_J`: Sigma J' (n x q); `flat`: the rows of f, of which q determines all. Nothing if S is not positive definite.
std::optional<FlatPriorUpdate> update_with_flat_prior(Eigen::MatrixXd Sigma_J, const Eigen::MatrixXd& J,
                                                      const Eigen::MatrixXd& C, Eigen::VectorXd v,
                                                      std::span<const int> flat);

}  // namespace seif
