// The measured part: everything live in Bullet, each stage with its clock.
#pragma once

#include <atomic>

#include "harness/stress/stress.hpp"
#include "harness/stress/warm_start.hpp"

namespace harness {

/// Runs the filters of `warm` on in `world`, from where the robot is, and fills in the row. Each runs alone,
/// on the same stream: beside a filter that goes through all of the caches, any other would be slow. What the
/// row says of everything else was measured with the first.
void measure_live(const StressPlan& plan, const worlds::World& world, WarmStart& warm,
                  const std::atomic<bool>& stop, StressRow& row);

}  // namespace harness
