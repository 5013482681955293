// The scores of a run as tables to read in a terminal.
#pragma once

#include <string>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/score/summary.hpp"

namespace harness {

/// The two tables of the scoreboard. The first has a row for each estimator and one for odometry, the second
/// a row for each estimator.
std::vector<TextRow> accuracy_table(const Summary& summary);
std::vector<TextRow> cost_table(const Summary& summary);

/// The scoreboard as text. It has at most 110 columns if names have at most 16 letters.
std::string scoreboard(const Summary& summary);

}  // namespace harness
