// The measured part of a stress test: everything live in Bullet, with a clock for each stage.
#pragma once

#include <atomic>

#include "harness/stress/stress.hpp"
#include "harness/stress/warm_start.hpp"

namespace harness {

/// Continues with the filters of `warm` in `world`, from the robot's position, and fills in the row. Each
/// filter runs alone on the same stream: a filter that uses up the whole cache would slow down any other. The
/// row's remaining values are measured with the first filter. Once `stop` is set, it returns without them.
void measure_live(const StressPlan& plan, const worlds::World& world, WarmStart& warm,
                  const std::atomic<bool>& stop, StressRow& row);

}  // namespace harness
