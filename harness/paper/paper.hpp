// Repeats section 4 of the 2002 report: its filters and ours on the same streams, over many seeds.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/comparison/comparison.hpp"
#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// A row of our table.
struct PaperRow {
  std::string_view estimator;  // name of the estimator in the world
  std::string_view settings;   // in YAML
  std::string_view title;      // as printed in the tables
  std::string_view update;     // growth of the update's time
};

/// The rows of the report's table, followed by the other filters.
inline constexpr std::array<PaperRow, 9> paper_rows = {{
    {"ekf", "{}", "EKF", "O(N^2)"},
    {"seif_exact", "{theta_x: 6}", "SEIF, exact mean", "Cholesky"},
    {"seif_report", "{theta_x: 6, K: 10}", "SEIF, constant time", "O(1)"},
    {"seif", "{}", "ours", "O(log N)"},
    {"seif_groups", "{type: seif, mean_recovery: multilevel}", "ours, mean by groups", "O(log N)"},
    {"seif_gauge_free", "{}", "our rule, exact mean", "Cholesky"},
    {"seif_modified", "{}", "modified rule, exact mean", "Cholesky"},
    {"eseif", "{}", "exactly sparse, exact mean", "Cholesky"},
    {"eif", "{}", "dense information filter", "O(N^3)"},
}};

/// Null if no row has this estimator.
const PaperRow* paper_row(std::string_view estimator);

struct PaperPlan {
  std::int64_t runs = 1'000;
  std::uint64_t first_seed = 1;  // the other runs have the following seeds
  int jobs = 1;                  // [-] runs at the same time
  bool physics = false;          // in Bullet instead of the kinematic engine
  std::vector<std::string> overrides;
  std::filesystem::path folder;  // it holds world.yaml
  bool quiet = false;
};

/// The differences from worlds/report2002.yaml, as path.to.key=value. The caller's own overrides come last.
std::vector<std::string> paper_overrides(const PaperPlan& plan);

/// Loads the world of the first seed.
worlds::LoadResult load_paper_world(const PaperPlan& plan, const seif::Registry& registry);

/// Loads the world of another seed from world.yaml. Throws BadInput if it cannot be loaded.
worlds::World paper_world(const PaperPlan& plan, std::uint64_t seed, const seif::Registry& registry);

/// Executes all runs. Ratios are relative to the EKF.
Comparison run_paper(const PaperPlan& plan, const std::string& name, const seif::Registry& registry);

}  // namespace harness
