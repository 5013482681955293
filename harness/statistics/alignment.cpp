#include "harness/statistics/alignment.hpp"

#include <cmath>
#include <stdexcept>

namespace harness {

std::optional<seif::Pose2> align(std::span<const Eigen::Vector2d> p_from,
                                 std::span<const Eigen::Vector2d> p_to) {
  if (p_from.size() != p_to.size()) throw std::invalid_argument("align: each point needs its counterpart");
  if (p_from.empty()) return std::nullopt;
  Eigen::Vector2d mean_from = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_to = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < p_from.size(); ++i) {
    mean_from += p_from[i];
    mean_to += p_to[i];
  }
  const auto count = static_cast<double>(p_from.size());
  mean_from /= count;
  mean_to /= count;

  // The best rotation maximises sum q_to . R q_from = cos(theta) * dot + sin(theta) * cross. The q are the
  // points relative to their mean.
  double dot = 0.0;
  double cross = 0.0;
  double spread = 0.0;
  for (std::size_t i = 0; i < p_from.size(); ++i) {
    const Eigen::Vector2d q_from = p_from[i] - mean_from;
    const Eigen::Vector2d q_to = p_to[i] - mean_to;
    dot += q_from.dot(q_to);
    cross += q_from.x() * q_to.y() - q_from.y() * q_to.x();
    spread += q_from.squaredNorm() + q_to.squaredNorm();
  }
  // If all points are equal, rounding errors alone remain; they define no rotation.
  const double rounding = 1e-24 * count * (mean_from.squaredNorm() + mean_to.squaredNorm());
  if (spread <= rounding || std::hypot(dot, cross) <= 1e-12 * spread) return std::nullopt;
  const seif::Pose2 rotation{0.0, 0.0, seif::wrap_angle(std::atan2(cross, dot))};
  const Eigen::Vector2d offset = mean_to - rotation * mean_from;
  return seif::Pose2{offset.x(), offset.y(), rotation.theta};
}

}  // namespace harness
