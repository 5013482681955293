#include "seif/relocating/rigid_fit.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

namespace seif {

std::optional<Pose2> rigid_fit(std::span<const Eigen::Vector2d> p_a, std::span<const Eigen::Vector2d> p_b) {
  if (p_a.size() < 2) return std::nullopt;
  Eigen::Vector2d centre_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d centre_b = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < p_a.size(); ++i) {
    centre_a += p_a[i];
    centre_b += p_b[i];
  }
  centre_a /= static_cast<double>(p_a.size());
  centre_b /= static_cast<double>(p_a.size());
  double cosine = 0.0;  // of the angle of the turn; both times the same factor
  double sine = 0.0;
  for (std::size_t i = 0; i < p_a.size(); ++i) {
    const Eigen::Vector2d a = p_a[i] - centre_a;
    const Eigen::Vector2d b = p_b[i] - centre_b;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const double angle = cosine == 0.0 && sine == 0.0 ? 0.0 : std::atan2(sine, cosine);
  const Eigen::Vector2d p = centre_b - Eigen::Rotation2Dd(angle) * centre_a;
  return Pose2{p.x(), p.y(), wrap_angle(angle)};
}

}  // namespace seif
