#include "seif/tree/group_motion.hpp"

#include <Eigen/Geometry>

namespace seif {

/// In the axes of the group the strain is E = [dilation + a, b; b, dilation - a].
Eigen::Matrix<double, 2, 3> strain_columns(const Lever& lever) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(lever.turn).toRotationMatrix();
  const Eigen::Vector2d arm = R.transpose() * lever.arm;
  Eigen::Matrix<double, 2, 3> columns;
  columns << arm.x(), arm.x(), arm.y(),  //
      arm.y(), -arm.y(), arm.x();
  return R * columns;
}

/// A shear comes back to itself after half a turn.
Eigen::Matrix2d shears_of_tied(const Lever& lever) {
  return Eigen::Rotation2Dd(-2.0 * (lever.own_turn - lever.turn)).toRotationMatrix();
}

Eigen::Vector2d end_step(const Lever& lever, const GroupMotion& d, bool turning) {
  const Eigen::Vector2d strained = strain_columns(lever) * d.tail<3>();
  if (!turning) return d.head<2>() + d(2) * Eigen::Vector2d(-lever.arm.y(), lever.arm.x()) + strained;
  return d.head<2>() + Eigen::Rotation2Dd(d(2)) * (lever.arm + strained) - lever.arm;
}

GroupMotion tied_motion(const Lever& lever, const GroupMotion& d, bool turning) {
  GroupMotion motion;
  motion.head<2>() = end_step(lever, d, turning);
  motion.segment<2>(2) = d.segment<2>(2);
  motion.tail<2>() = shears_of_tied(lever) * d.tail<2>();
  return motion;
}

}  // namespace seif
