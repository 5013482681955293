#include "harness/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "harness/csv_reader.hpp"
#include "harness/scoreboard.hpp"

namespace harness {

void print_problems(std::vector<worlds::Problem> problems) {
  worlds::sort_by_place(problems);
  for (const worlds::Problem& problem : problems) fmt::print(stderr, "{}\n", worlds::to_string(problem));
}

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const BadInput& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "seifbed: {}\n", error.what());
    return 1;
  }
}

int print_result(const RunResult& result, const std::filesystem::path& folder, bool json, bool quiet) {
  if (!result.error.empty()) fmt::print(stderr, "{}\n", result.error);
  if (json) {
    fmt::print("{}", to_json(result.summary));
  } else if (!quiet) {
    fmt::print("{}\nWritten to {}\n", scoreboard(result.summary), folder.string());
  }
  if (std::fflush(stdout) != 0) {
    fmt::print(stderr, "seifbed: cannot write to the standard output\n");
    return 1;
  }
  return exit_code(result);
}

}  // namespace harness
