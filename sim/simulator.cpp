#include "sim/simulator.hpp"

#include <stdexcept>

#include "sim/near_solids.hpp"
#include "sim/robot_body.hpp"
#include "sim/sensing_world.hpp"
#include "sim/solids.hpp"
#include "sim/stepped_world.hpp"
#include "worlds/geometry.hpp"

namespace sim {

namespace {

int checked_step_rate(const worlds::Physics& physics) {
  if (physics.step_rate <= 0) {
    throw std::invalid_argument("simulator: the step rate must be positive");
  }
  return physics.step_rate;
}

}  // namespace

/// Destroyed from the last to the first: what stands in the stepped world leaves it before it goes.
struct Simulator::Impl {
  explicit Impl(const worlds::World& world)
      : step_rate(checked_step_rate(world.physics)),
        solids(world),
        sensing(solids),
        stepped(world.robot.mass),
        robot(world.robot, world.physics, stepped),
        near_solids(solids, sensing, stepped, worlds::footprint_radius(world.robot)) {}

  int step_rate;  // [Hz]
  Solids solids;
  SensingWorld sensing;
  SteppedWorld stepped;
  RobotBody robot;
  NearSolids near_solids;
  std::int64_t steps = 0;
  std::int64_t objects_stepped = 0;
};

Simulator::Simulator(const worlds::World& world) : impl_(std::make_unique<Impl>(world)) {}

Simulator::~Simulator() = default;

void Simulator::step(const Command& command) {
  const double dt = 1.0 / impl_->step_rate;
  impl_->robot.drive(command, dt);
  impl_->near_solids.follow(impl_->robot.position());
  impl_->stepped.step(dt);
  impl_->robot.read_joints();
  ++impl_->steps;
  impl_->objects_stepped += impl_->stepped.objects();
}

RobotState Simulator::robot() const {
  RobotState state = impl_->robot.state();
  state.t = static_cast<double>(impl_->steps) / impl_->step_rate;  // not a sum: no rounding gathers
  return state;
}

void Simulator::landmarks_within(const Eigen::Vector2d& p_world, double radius, std::vector<int>& out) const {
  impl_->sensing.landmarks_within(p_world, radius, out);
}

bool Simulator::line_of_sight(const Eigen::Vector2d& p_world_sensor, int landmark) const {
  if (landmark < 0 || landmark >= impl_->solids.size() || !impl_->solids.is_landmark(landmark)) {
    throw std::out_of_range("simulator: there is no landmark of that index");
  }
  return impl_->sensing.line_of_sight(p_world_sensor, landmark);
}

bool Simulator::path_is_clear(const Eigen::Vector2d& p_world_from, const Eigen::Vector2d& p_world_to,
                              double radius) const {
  return impl_->sensing.path_is_clear({p_world_from, p_world_to}, radius);
}

SimulatorCounts Simulator::counts() const {
  const QueryCounts& queries = impl_->sensing.counts();
  return {impl_->steps, impl_->objects_stepped, queries.rays, queries.candidates};
}

}  // namespace sim
