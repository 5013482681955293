#include "sim/simulator.hpp"

#include <stdexcept>

#include "sim/bullet_simulator.hpp"
#include "sim/kinematic_simulator.hpp"

namespace sim {

std::unique_ptr<Simulator> make_simulator(const worlds::World& world) {
  if (world.physics.step_rate <= 0) {
    throw std::invalid_argument("simulator: the step rate must be positive");
  }
  switch (world.physics.engine) {
    case worlds::Engine::bullet:
      return std::make_unique<BulletSimulator>(world);
    case worlds::Engine::kinematic:
      return std::make_unique<KinematicSimulator>(world);
  }
  throw std::invalid_argument("simulator: there is no such engine");
}

}  // namespace sim
