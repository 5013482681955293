// One robot of a Bullet world.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "sim/bullet_arena.hpp"
#include "sim/simulator.hpp"

namespace sim {

class BulletSimulator final : public Simulator {
 public:
  /// The robot shares the arena with the others.
  BulletSimulator(std::shared_ptr<BulletArena> arena, std::size_t robot)
      : arena_(std::move(arena)), robot_(robot) {}

  void step(const Command& command) override { arena_->command(robot_, command); }
  void place(const worlds::Placement& T_world_robot) override;
  RobotState robot() const override { return arena_->state(robot_); }
  int add_landmark(const worlds::Landmark& landmark) override { return arena_->add_landmark(landmark); }
  void add_wall(const worlds::Wall& wall) override { arena_->add_wall(wall); }
  void add_patch(const worlds::FrictionPatch& patch) override { arena_->add_patch(patch); }
  void landmarks_within(const Eigen::Vector2d& p_world, double radius, std::vector<int>& out) const override;
  bool line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const override;
  bool path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                     double radius) const override;
  SimulatorCounts counts() const override { return arena_->counts(); }

 private:
  std::shared_ptr<BulletArena> arena_;
  std::size_t robot_;
};

}  // namespace sim
