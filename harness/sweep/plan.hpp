// What a sweep runs: the product of settings and seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace harness {

/// A value of the world file that the sweep varies.
struct SweepAxis {
  std::string path;                 // for instance `estimators.seif.theta_x`
  std::vector<std::string> values;  // YAML as written; all different

  bool operator==(const SweepAxis&) const = default;
};

/// Everything that determines the results. Two sweeps with equal plans and equal world files are the same
/// sweep.
struct SweepPlan {
  std::string name;                  // of the world
  std::string version;               // of the program
  std::string baseline;              // the estimator that differences are relative to
  std::vector<std::uint64_t> seeds;  // ascending
  std::vector<SweepAxis> axes;

  bool operator==(const SweepPlan&) const = default;
};

/// One run of a sweep. In the order of cells the seed changes fastest, then the last axis.
struct SweepCell {
  std::size_t setting = 0;  // [-] index
  std::uint64_t seed = 0;
};

/// The largest number of cells of a sweep.
inline constexpr std::size_t most_cells = 10'000'000;

/// Reads `path=v1,v2,..`. Commas inside brackets, braces or quotes do not separate values. Throws BadInput.
SweepAxis parse_axis(std::string_view text);

/// Throws BadInput if an axis occurs twice or sets the whole section of an earlier one, or if there are more than most_cells cells.
void check_plan(const SweepPlan& plan);

/// Throws BadInput if one of these, path.to.key=value for all runs, sets what the plan varies.
void check_overrides(const SweepPlan& plan, const std::vector<std::string>& overrides);

std::size_t setting_count(const SweepPlan& plan);
std::size_t cell_count(const SweepPlan& plan);
SweepCell cell_at(const SweepPlan& plan, std::size_t index);

/// The values of the axes, in the order of the axes.
std::vector<std::string> values_of(const SweepPlan& plan, std::size_t setting);

/// A short name for each axis: the last key of its path, or the whole path if another axis has the same last
/// key.
std::vector<std::string> short_paths(const SweepPlan& plan);

/// The changes from the sweep's world to that of a cell: `path.to.key=value`.
std::vector<std::string> overrides_of(const SweepPlan& plan, const SweepCell& cell);

/// A text such as "seif.theta_x=6, seed 3".
std::string describe_cell(const SweepPlan& plan, std::size_t index);

std::string to_json(const SweepPlan& plan);

/// Reads a plan. Throws BadInput, with `file` in the message.
SweepPlan plan_from_json(const std::string& text, const std::string& file);

/// The first difference between two different plans, as in "its seeds are 1..5, and not 1..8".
std::string difference_between(const SweepPlan& its, const SweepPlan& ours);

}  // namespace harness
