// Our results beside the report's, as a table for people and as JSON.
#pragma once

#include <string>

#include "harness/comparison/comparison.hpp"
#include "harness/paper/paper.hpp"

namespace harness {

/// The tables, what their columns mean, and what failed.
std::string paper_board(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison);

/// The same bytes whatever the jobs.
std::string paper_json(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison);

/// A row for each run and estimator.
std::string paper_runs_csv(const Comparison& comparison);

/// Measured times.
std::string paper_times_json(const PaperPlan& plan, const Comparison& comparison);

}  // namespace harness
