#include "harness/score/rebuilt.hpp"

#include <cmath>

#include "harness/statistics/chi_square.hpp"

namespace harness {

ScanNisScore score_scans(std::span<const ScanNis> scans) {
  ScanNisScore score;
  double sum = 0.0;
  double inside = 0.0;
  int degrees = 0;
  for (const ScanNis& scan : scans) {
    sum += scan.degrees * scan.nis;
    degrees += scan.degrees;
    inside += share_inside({&scan.nis, 1}, chi_square_band(scan.degrees)).value();
  }
  if (degrees == 0) return score;
  score.nis = sum / degrees;
  score.band = chi_square_band(degrees);
  score.count = scans.size();
  score.inside = inside / static_cast<double>(scans.size());
  return score;
}

std::optional<double> nees_from_robot(const PosePair& pose, const PointPair& landmark,
                                      const Eigen::Matrix<double, 5, 5>& joint) {
  const Eigen::Vector2d est_p_robot = inverse(pose.est_pose) * landmark.est_point;
  const Eigen::Vector2d true_p_robot = inverse(pose.true_pose) * landmark.true_point;
  const double c = std::cos(pose.est_pose.theta);
  const double s = std::sin(pose.est_pose.theta);
  const Eigen::Matrix2d R_robot_world{{c, s}, {-s, c}};
  Eigen::Matrix<double, 2, 5> J;  // of p_robot = R' (m - p) wrt [x y theta m_x m_y]
  J << -R_robot_world, Eigen::Vector2d(est_p_robot.y(), -est_p_robot.x()), R_robot_world;
  return nees(Eigen::Vector2d(est_p_robot - true_p_robot), Eigen::Matrix2d(J * joint * J.transpose()));
}

}  // namespace harness
