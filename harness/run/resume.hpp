// Completes a run that was interrupted or cut off.
#pragma once

#include <filesystem>

#include "harness/run/run.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Whether a run is incomplete. Throws BadInput if this is not the folder of a run.
bool is_incomplete(const std::filesystem::path& run);

/// Simulates such a run again from its world.yaml, in another folder, and replaces the incomplete run: the same
/// bytes as an undisturbed run, except for times. The recorded part must come again to the bit; otherwise throws
/// std::runtime_error. If that happens, or this is interrupted, the folder stays unchanged. Throws
/// BadInput for a world that cannot be read.
RunResult resume(const std::filesystem::path& run, const seif::Registry& registry, bool quiet);

}  // namespace harness
