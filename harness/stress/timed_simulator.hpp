// A simulator that measures its own time.
#pragma once

#include <memory>
#include <vector>

#include "sim/simulator.hpp"

namespace harness {

/// Passes all calls on to another simulator, and measures the time of each physics step.
class TimedSimulator final : public sim::Simulator {
 public:
  /// The time of each step is appended to `step_us`. If it has enough capacity, this allocates nothing.
  TimedSimulator(std::unique_ptr<sim::Simulator> simulator, std::vector<double>& step_us);

  void step(const sim::Command& command) override;

  void place(const worlds::Placement& T_world_robot) override { simulator_->place(T_world_robot); }
  int add_landmark(const worlds::Landmark& landmark) override { return simulator_->add_landmark(landmark); }
  void add_wall(const worlds::Wall& wall) override { simulator_->add_wall(wall); }
  void add_patch(const worlds::FrictionPatch& patch) override { simulator_->add_patch(patch); }
  sim::RobotState robot() const override { return simulator_->robot(); }
  void landmarks_within(const Eigen::Vector2d& p_world, double radius, std::vector<int>& out) const override {
    simulator_->landmarks_within(p_world, radius, out);
  }
  bool line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const override {
    return simulator_->line_of_sight(p_world_sensor, landmark);
  }
  bool path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                     double radius) const override {
    return simulator_->path_is_clear(p_world_from, p_world_to, radius);
  }
  sim::SimulatorCounts counts() const override { return simulator_->counts(); }

 private:
  std::unique_ptr<sim::Simulator> simulator_;
  std::vector<double>& step_us_;
};

}  // namespace harness
