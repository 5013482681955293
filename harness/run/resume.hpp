// Completes a run that was interrupted or cut off.
#pragma once

#include <filesystem>

#include "harness/run/run.hpp"
#include "seif/registry.hpp"

namespace harness {

/// True if a part of the run is missing. Throws BadInput if `run` is not a run folder.
bool is_incomplete(const std::filesystem::path& run);

/// Simulates the run again from its world.yaml and then replaces the folder's files. The result has the same
/// bytes as an uninterrupted run, except for times. The new run must repeat the record to the bit, otherwise
/// this throws std::runtime_error. The folder is unchanged if this throws, is interrupted or fails. Throws
/// BadInput if the world cannot be read.
RunResult resume(const std::filesystem::path& run, const seif::Registry& registry, bool quiet);

}  // namespace harness
