#include "harness/sweep/status.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace harness {

SweepStatus status_of(const SweepFolder& sweep) {
  SweepStatus status;
  const std::vector<CellState> states = sweep.states();
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] == CellState::done) ++status.done;
    if (states[i] == CellState::open) ++status.open;
    if (states[i] == CellState::failed) status.failed.push_back({i, sweep.cells().failure(i)});
  }
  return status;
}

std::string to_text(const SweepFolder& sweep, const SweepStatus& status) {
  return fmt::format("{}: {} of {} runs done, {} failed, {} open\n", sweep.plan.name, status.done,
                     cell_count(sweep.plan), status.failed.size(), status.open) +
         failed_lines(sweep.plan, status.failed);
}

std::string failed_lines(const SweepPlan& plan, const std::vector<FailedCell>& failed) {
  constexpr std::size_t most = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, failed.size()); ++i)
    text += fmt::format("{}: {}\n", describe_cell(plan, failed[i].index), failed[i].reason);
  if (failed.size() > most) text += fmt::format("and {} more\n", failed.size() - most);
  return text;
}

}  // namespace harness
