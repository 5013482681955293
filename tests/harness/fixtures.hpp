// Worlds, files and an estimator for the tests of the harness.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "harness/recording/run_folder.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/run/run.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness::test {

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

/// A square of 6 m that the robot drives along, with twelve landmarks outside, for 20 s; estimators `ekf` and
/// `seif_report`.
worlds::World small_world();

/// Runs a world live in a new folder, with the estimators of `registry`, or of test_registry() if none is
/// given.
RunResult run_live(const worlds::World& world, const std::filesystem::path& folder);
RunResult run_live(const worlds::World& world, const std::filesystem::path& folder,
                   const seif::Registry& registry);

/// Replays a folder with the world's estimators, and writes to another folder.
RunResult replay(const worlds::World& world, const std::filesystem::path& from,
                 const std::filesystem::path& to);

/// The estimators of the program, and `dead_reckoning`, whose map stays empty, and which throws after
/// `fail_after_scans` scans if that is not zero.
seif::Registry test_registry();

/// An estimator with the default options of its type.
worlds::EstimatorChoice choice(const std::string& type);

}  // namespace harness::test
