// The scores of a run as tables to read in a terminal.
#pragma once

#include <filesystem>
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

/// The lines below its tables: what was left out, what diverged, what failed. A paragraph begins with an empty
/// line; no paragraph, no text.
std::string scoreboard_notes(const Summary& summary);

/// A paragraph for the reader of the tables if the log does not hold the truth; otherwise no text.
std::string without_truth(const std::filesystem::path& run);

}  // namespace harness
