// A world in words, for people who read a page and have no world file beside them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/report/page.hpp"
#include "harness/stream/log_description.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The world of a folder; nothing if it has no world.yaml, or one that this program does not understand.
std::optional<worlds::World> world_of(const std::filesystem::path& folder, const seif::Registry& registry);

/// Its size, what stands in it, how the robot drives, and what its sensors measure.
Description describe(const worlds::World& world);

/// What is known of a log that has no world file.
Description describe(const LogDescription& log);

/// The estimators with their types and all their options.
Description describe(const std::vector<worlds::EstimatorChoice>& estimators);

}  // namespace harness
