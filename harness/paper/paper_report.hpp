// Our results beside those of the report, as tables and as JSON.
#pragma once

#include <string>
#include <vector>

#include "harness/comparison/comparison.hpp"
#include "harness/files/text_table.hpp"
#include "harness/paper/paper.hpp"

namespace harness {

/// Errors, links and time, and consistency, beside what the report has of them.
std::vector<std::vector<TextRow>> paper_tables(const Comparison& comparison);

/// The tables, the meaning of their columns, and the failures.
std::string paper_board(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison);

/// The results as JSON. The bytes do not depend on the number of jobs.
std::string paper_json(const PaperPlan& plan, const worlds::World& world, const Comparison& comparison);

/// A row for each run and estimator.
std::string paper_runs_csv(const Comparison& comparison);

/// The measured times as JSON.
std::string paper_times_json(const PaperPlan& plan, const Comparison& comparison);

}  // namespace harness
