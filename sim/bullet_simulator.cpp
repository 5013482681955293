#include "sim/bullet_simulator.hpp"

#include <stdexcept>

#include "sim/drive_limits.hpp"

namespace sim {

void BulletSimulator::place(const worlds::Placement& T_world_robot) {
  check_place(T_world_robot);
  arena_->place(robot_, T_world_robot);
}

void BulletSimulator::landmarks_within(const Eigen::Vector2d& p_world, double radius,
                                       std::vector<int>& out) const {
  arena_->sensing().landmarks_within(p_world, radius, out);
}

bool BulletSimulator::line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const {
  if (landmark < 0 || landmark >= arena_->solids().landmarks()) {
    throw std::out_of_range("simulator: there is no landmark of that index");
  }
  const Eigen::Vector2d centre = arena_->solids().landmark(landmark).centre;
  return arena_->is_clear_of_others(robot_, {p_world_sensor, centre}, 0.0) &&
         arena_->sensing().line_of_sight(p_world_sensor, landmark);
}

bool BulletSimulator::path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                                    double radius) const {
  const Segment way{p_world_from, p_world_to};
  return arena_->is_clear_of_others(robot_, way, radius) && arena_->sensing().path_is_clear(way, radius);
}

}  // namespace sim
