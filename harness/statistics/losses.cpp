#include "harness/statistics/losses.hpp"

#include <Eigen/Cholesky>
#include <utility>

#include "harness/statistics/divergence.hpp"

namespace harness {

std::optional<double> squared_distance(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
  const Eigen::LLT<Eigen::Matrix3d> L(covariance);
  if (L.info() != Eigen::Success) return std::nullopt;
  return L.matrixL().solve(error).squaredNorm();
}

void Losses::add(const UpdateOfLoss& update) {
  const bool is_shut_out = !update.has_used && update.left_out > 0;
  if (is_shut_out && scans_++ == 0) before_ = update.t;
  if (scans_ == 0) return;
  if (is_shut_out && scans_ == fewest_scans) ++count_;
  if (is_lost()) lost_s_ += update.t - std::exchange(before_, update.t);
  if (update.relocations > 0) note_found(update);
  if (update.relocations > 0 || update.has_used) scans_ = 0;
}

void Losses::note_found(const UpdateOfLoss& update) {
  ++found_;
  if (update.distance.value_or(0.0) > 3.0 * highest_nees_pose()) ++wrong_;
  found_t_ = update.t;
  if (!first_found_t_) first_found_t_ = update.t;
}

}  // namespace harness
