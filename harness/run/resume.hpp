// The rest of a run that was interrupted or cut off.
#pragma once

#include <filesystem>

#include "harness/run/run.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Whether something of a run is missing. Throws BadInput if this is no folder of a run.
bool is_incomplete(const std::filesystem::path& run);

/// Simulates such a run again from its world.yaml, beside it, and puts the whole in its place: the same bytes
/// as if nothing had happened, but for times. What was recorded must come again, to the bit; otherwise
/// std::runtime_error, and the folder stays as it was. So it does if this is interrupted or fails. Throws
/// BadInput for a world that cannot be read.
RunResult resume(const std::filesystem::path& run, const seif::Registry& registry, bool quiet);

}  // namespace harness
