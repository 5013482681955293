// Our results beside those of the report, as tables and as JSON.
#pragma once

#include <string>

#include "harness/comparison/comparison.hpp"
#include "harness/paper/paper.hpp"

namespace harness {

/// The tables, the meaning of their columns, and the failures.
std::string paper_board(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison);

/// The results as JSON. The bytes do not depend on the number of jobs.
std::string paper_json(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison);

/// A row for each run and estimator.
std::string paper_runs_csv(const Comparison& comparison);

/// The measured times as JSON.
std::string paper_times_json(const PaperPlan& plan, const Comparison& comparison);

}  // namespace harness
