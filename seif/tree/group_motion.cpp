#include "seif/tree/group_motion.hpp"

#include <Eigen/Geometry>

namespace seif {

Eigen::Vector2d end_step(const Lever& lever, const GroupMotion& d, bool turning) {
  if (!turning) return d.head<2>() + d(2) * Eigen::Vector2d(-lever.y(), lever.x()) + d(3) * lever;
  return d.head<2>() + Eigen::Rotation2Dd(d(2)) * Eigen::Vector2d((1.0 + d(3)) * lever) - lever;
}

GroupMotion tied_motion(const Lever& lever, const GroupMotion& d, bool turning) {
  GroupMotion motion = d;
  motion.head<2>() = end_step(lever, d, turning);
  return motion;
}

}  // namespace seif
