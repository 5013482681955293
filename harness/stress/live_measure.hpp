// The measured part: everything live in Bullet, each stage with its clock.
#pragma once

#include <atomic>

#include "harness/stress/stress.hpp"
#include "harness/stress/warm_start.hpp"

namespace harness {

/// Continues the filters of `warm` in `world`, from the robot's present pose, and fills in the row. Each runs
/// alone, on the same stream: beside a filter that uses all of the caches, any other would be slow. Everything
/// else in the row is measured with the first filter.
void measure_live(const StressPlan& plan, const worlds::World& world, WarmStart& warm,
                  const std::atomic<bool>& stop, StressRow& row);

}  // namespace harness
