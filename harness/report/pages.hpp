// Report pages for the folders that the program writes.
#pragma once

#include <filesystem>

#include "harness/report/page.hpp"
#include "seif/registry.hpp"

namespace harness {

// All these functions throw BadInput if a file of the folder is missing or broken.

/// The page of a run or a replay. If `replays` is true, the run is replayed for scores that the folder does
/// not hold.
Page run_page(const std::filesystem::path& folder, const seif::Registry& registry, bool replays);

/// The page of a finished sweep.
Page sweep_page(const std::filesystem::path& folder);

/// The page of a stress test.
Page stress_page(const std::filesystem::path& folder);

/// The page of a comparison, from the folder of compare's --out.
Page comparison_page(const std::filesystem::path& folder);

/// The page of what seifbed paper has written.
Page paper_page(const std::filesystem::path& folder, const seif::Registry& registry);

/// The page for the kind of folder that this is.
Page page_of(const std::filesystem::path& folder, const seif::Registry& registry, bool replays);

}  // namespace harness
