// The plan of a sweep: the product of settings and seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace harness {

/// A value of the world file that is varied.
struct SweepAxis {
  std::string path;                 // as in `estimators.seif.theta_x`
  std::vector<std::string> values;  // YAML, as written; distinct

  bool operator==(const SweepAxis&) const = default;
};

/// Everything that decides the result. Two sweeps with equal plans and equal world files are the same.
struct SweepPlan {
  std::string name;                  // of the world
  std::string version;               // of the program
  std::string baseline;              // the estimator to which differences are taken
  std::vector<std::uint64_t> seeds;  // ascending
  std::vector<SweepAxis> axes;

  bool operator==(const SweepPlan&) const = default;
};

/// One run of a sweep. The seeds change fastest, and then the last axis.
struct SweepCell {
  std::size_t setting = 0;  // [-] index
  std::uint64_t seed = 0;
};

/// The most cells that a sweep may have.
inline constexpr std::size_t most_cells = 10'000'000;

/// Reads `path=v1,v2,..`. A comma inside brackets, braces or quotes does not separate. Throws BadInput.
SweepAxis parse_axis(std::string_view text);

/// Throws BadInput if an axis stands twice, or there are more than most_cells.
void check_plan(const SweepPlan& plan);

std::size_t setting_count(const SweepPlan& plan);
std::size_t cell_count(const SweepPlan& plan);
SweepCell cell_at(const SweepPlan& plan, std::size_t index);

/// The values of the axes, in their order.
std::vector<std::string> values_of(const SweepPlan& plan, std::size_t setting);

/// The path of each axis for people: its last key, or all of it where another axis has the same.
std::vector<std::string> short_paths(const SweepPlan& plan);

/// The overrides that make the world of a cell: `path.to.key=value`.
std::vector<std::string> overrides_of(const SweepPlan& plan, const SweepCell& cell);

/// "seif.theta_x=6, seed 3", for people.
std::string describe_cell(const SweepPlan& plan, std::size_t index);

std::string to_json(const SweepPlan& plan);

/// Throws BadInput, which names `file`.
SweepPlan plan_from_json(const std::string& text, const std::string& file);

/// The first difference between two plans, as in "its seeds are 1..5, and not 1..8".
std::string difference_between(const SweepPlan& its, const SweepPlan& ours);

}  // namespace harness
