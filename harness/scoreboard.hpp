// The scores of a run as a table for people.
#pragma once

#include <string>

#include "harness/summary.hpp"

namespace harness {

/// At most 110 columns wide, for names of up to 16 letters.
std::string scoreboard(const Summary& summary);

}  // namespace harness
