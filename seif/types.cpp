#include "seif/types.hpp"

#include <cmath>
#include <numbers>

namespace seif {

double wrap_angle(double angle) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  const double wrapped = std::remainder(angle, two_pi);  // [-pi, pi]
  return wrapped <= -std::numbers::pi ? wrapped + two_pi : wrapped;
}

Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Eigen::Vector2d p_a_c = T_a_b * Eigen::Vector2d(T_b_c.x, T_b_c.y);
  return {p_a_c.x(), p_a_c.y(), wrap_angle(T_a_b.theta + T_b_c.theta)};
}

Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b) {
  const double c = std::cos(T_a_b.theta);
  const double s = std::sin(T_a_b.theta);
  return {T_a_b.x + c * p_b.x() - s * p_b.y(), T_a_b.y + s * p_b.x() + c * p_b.y()};
}

Pose2 inverse(const Pose2& T_a_b) {
  const double c = std::cos(T_a_b.theta);
  const double s = std::sin(T_a_b.theta);
  return {-c * T_a_b.x - s * T_a_b.y, s * T_a_b.x - c * T_a_b.y, wrap_angle(-T_a_b.theta)};
}

}  // namespace seif
