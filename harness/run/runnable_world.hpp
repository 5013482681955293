// Loading a world that is to run: the one function by which a command decides whether a world file is good.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// Loads a world as worlds::load_world does, and makes each of its estimators as prepare_run will. An estimator
/// that cannot run in this world is a problem at its place. So what `run` refuses because of the world file,
/// `validate` refuses too.
worlds::LoadResult load_runnable_world(const std::filesystem::path& file,
                                       const std::vector<std::string>& overrides,
                                       const seif::Registry& registry, std::string_view version = "");

}  // namespace harness
