#include "harness/stress/timed_simulator.hpp"

#include <chrono>
#include <utility>

namespace harness {

TimedSimulator::TimedSimulator(std::unique_ptr<sim::Simulator> simulator, std::vector<double>& step_us)
    : simulator_(std::move(simulator)), step_us_(step_us) {}

void TimedSimulator::step(const sim::Command& command) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  simulator_->step(command);
  step_us_.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
}

}  // namespace harness
