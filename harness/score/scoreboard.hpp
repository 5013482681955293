// The scores of a run as a table for people.
#pragma once

#include <string>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/score/summary.hpp"

namespace harness {

/// Its parts: a row for each estimator and for odometry, and one for each estimator.
std::vector<TextRow> accuracy_table(const Summary& summary);
std::vector<TextRow> cost_table(const Summary& summary);

/// At most 110 columns wide, for names of up to 16 letters.
std::string scoreboard(const Summary& summary);

}  // namespace harness
