// The progress of a sweep.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/sweep/aggregate.hpp"
#include "harness/sweep/folder.hpp"

namespace harness {

struct SweepStatus {
  std::size_t done = 0;
  std::size_t open = 0;
  std::vector<FailedCell> failed;
};

SweepStatus status_of(const SweepFolder& sweep);

/// One line of counts, and one line for each of the first failures.
std::string to_text(const SweepFolder& sweep, const SweepStatus& status);

/// One line for each of the first failed cells, and one for the number of the others.
std::string failed_lines(const SweepPlan& plan, const std::vector<FailedCell>& failed);

}  // namespace harness
