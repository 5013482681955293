#include "seif/dense/flat_prior.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <utility>

namespace seif {

std::optional<FlatPriorUpdate> update_with_flat_prior(Eigen::MatrixXd Sigma_J, const Eigen::MatrixXd& J,
                                                      const Eigen::MatrixXd& C, Eigen::VectorXd v,
                                                      std::span<const int> flat) {
  const Eigen::LLT<Eigen::MatrixXd> S(J * Sigma_J + C);
  if (S.info() != Eigen::Success) return std::nullopt;
  S.matrixL().solveInPlace(v);
  S.matrixU().solveInPlace<Eigen::OnTheRight>(Sigma_J);
  const auto f = static_cast<Eigen::Index>(flat.size());
  Eigen::MatrixXd J_f(J.rows(), f);
  for (Eigen::Index i = 0; i < f; ++i) J_f.col(i) = J.col(flat[static_cast<std::size_t>(i)]);
  S.matrixL().solveInPlace(J_f);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(J_f);
  const Eigen::MatrixXd Q = qr.householderQ();
  const Eigen::MatrixXd R = qr.matrixQR().topRows(f);
  const Eigen::MatrixXd G = R.triangularView<Eigen::Upper>().solve(Q.leftCols(f).transpose());
  const auto Q_2 = Q.rightCols(J.rows() - f);
  FlatPriorUpdate update;
  update.W = Sigma_J * Q_2;
  update.step = update.W * (Q_2.transpose() * v);
  update.step_f = G * v;
  update.P = G * G.transpose();
  update.cross = -G * Sigma_J.transpose();
  return update;
}

}  // namespace seif
