#include "sim/simulator.hpp"

#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

#include "sim/bullet_arena.hpp"
#include "sim/bullet_simulator.hpp"
#include "sim/kinematic_simulator.hpp"

namespace sim {
namespace {

std::vector<std::unique_ptr<Simulator>> make_all(const worlds::World& world,
                                                 std::span<const worlds::Placement> starts) {
  if (world.physics.step_rate <= 0) throw std::invalid_argument("simulator: the step rate must be positive");
  std::vector<std::unique_ptr<Simulator>> simulators;
  switch (world.physics.engine) {
    case worlds::Engine::bullet: {
      const auto arena = std::make_shared<BulletArena>(world, starts);
      for (std::size_t i = 0; i < starts.size(); ++i)
        simulators.push_back(std::make_unique<BulletSimulator>(arena, i));
      return simulators;
    }
    case worlds::Engine::kinematic:
      for (const worlds::Placement& start : starts)
        simulators.push_back(std::make_unique<KinematicSimulator>(world, start));
      return simulators;
  }
  throw std::invalid_argument("simulator: there is no such engine");
}

}  // namespace

std::unique_ptr<Simulator> make_simulator(const worlds::World& world) {
  return std::move(make_all(world, std::span(&world.robot.start, 1)).front());
}

std::vector<std::unique_ptr<Simulator>> make_team(const worlds::World& world) {
  std::vector<worlds::Placement> starts;
  for (const worlds::TeamRobot& robot : world.robots) starts.push_back(robot.start);
  return make_all(world, starts);
}

}  // namespace sim
