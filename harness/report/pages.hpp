// The pages of the folders that the program writes.
#pragma once

#include <filesystem>

#include "harness/report/page.hpp"
#include "seif/registry.hpp"

namespace harness {

// All throw BadInput if a file of the folder is missing or broken.

/// Of a run or of a replay. With `replays` it is fed to its estimators again, for what the folder does not
/// hold.
Page run_page(const std::filesystem::path& folder, const seif::Registry& registry, bool replays);

/// The page of a finished sweep.
Page sweep_page(const std::filesystem::path& folder);

/// The page of a stress test.
Page stress_page(const std::filesystem::path& folder);

/// The page that fits to what is in the folder.
Page page_of(const std::filesystem::path& folder, const seif::Registry& registry, bool replays);

}  // namespace harness
