// The keys of comparison.json and paper.json, in one table for writing and reading.
#pragma once

#include <string>

#include "harness/comparison/comparison.hpp"

namespace harness {

/// All values of an estimator, as JSON.
std::string comparison_keys_json(const EstimatorComparison& estimator);

/// Reads the values whose keys are there; the others stay as they are. This and parse_comparison() throw the
/// JSON library's exceptions.
void read_comparison_keys(const std::string& json, EstimatorComparison& estimator);

/// Reads the text of a comparison.json, or of a paper.json, which has no runs. Of a run's summary it reads what
/// read_summary() does. Throws BadInput too.
Comparison parse_comparison(const std::string& text);

}  // namespace harness
