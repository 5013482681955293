#include "harness/recording/unfinished.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <system_error>

#include "harness/files/bad_input.hpp"
#include "harness/files/file_lock.hpp"
#include "harness/files/input_file.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

namespace fs = std::filesystem;

/// The next line; false if its line end is missing.
bool next_whole_line(std::ifstream& file, std::string& line) {
  return std::getline(file, line) && !file.eof();
}

/// The time at the beginning of a row; empty for a header.
std::optional<double> time_of(const std::string& row) {
  double t = 0.0;
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), t);
  return error == std::errc{} ? std::optional(t) : std::nullopt;
}

/// The last time for which a table is complete. In a table with groups of rows of equal time, the last group
/// may be incomplete.
double reach_of(const fs::path& table, bool has_groups) {
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  double last = nothing;
  double before_last = nothing;
  if (!fs::exists(table)) return nothing;
  std::ifstream file = open_input(table);
  for (std::string line; next_whole_line(file, line);) {
    const std::optional<double> t = time_of(line);
    if (!t || *t == last) continue;
    before_last = last;
    last = *t;
  }
  return has_groups ? before_last : last;
}

/// True if the rows of this file begin with a time.
bool is_timed(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name == "landmarks.csv" || name == "commands.csv" || name.ends_with("_map.csv")) return false;
  return file.extension() == ".csv" || file.extension() == ".tum";
}

void copy_rows(const fs::path& table, const fs::path& to, double last_t) {
  OutputFile copy(to);
  std::ifstream file = open_input(table);
  for (std::string line; next_whole_line(file, line);) {
    const std::optional<double> t = time_of(line);
    if (t && *t > last_t) break;
    copy.append(line + '\n');
  }
  copy.close();
}

}  // namespace

bool is_unfinished(const fs::path& run) {
  std::error_code error;
  return fs::exists(run / unfinished_mark, error);
}

bool is_going_on(const fs::path& run) { return is_locked(run / unfinished_mark); }

void copy_whole_part(const fs::path& run, const fs::path& to) {
  double last_t = std::min(reach_of(run / "odometry.csv", false), reach_of(run / "observations.csv", true));
  for (const char* name : {"truth.csv", "observations_true_ids.csv"}) {
    if (fs::exists(run / name)) last_t = std::min(last_t, reach_of(run / name, name[0] == 'o'));
  }
  if (!(last_t > -std::numeric_limits<double>::infinity()))
    throw BadInput(run.string() + (is_going_on(run) ? ": is still going on, and nothing is recorded yet"
                                                    : ": was cut off before anything was recorded"));
  for (const fs::directory_entry& entry : fs::directory_iterator(run)) {
    const fs::path& file = entry.path();
    if (!entry.is_regular_file() || file.filename() == unfinished_mark) continue;
    if (is_timed(file)) {
      copy_rows(file, to / file.filename(), last_t);
    } else if (file.extension() == ".csv" || file.extension() == ".yaml") {
      fs::copy_file(file, to / file.filename());
    }
  }
}

fs::path whole_log(const fs::path& run, const fs::path& spare) {
  refuse_team_folder(run);
  if (!is_unfinished(run)) return run;
  copy_whole_part(run, spare);
  const std::string name = run.string();
  if (is_going_on(run)) {
    tell_warning(fmt::format("seifbed: {} is still going on: this is of what is whole of it so far", name));
  } else {
    tell_warning(
        fmt::format("seifbed: {0} was cut off before its end: this is of what is whole of it "
                    "(seifbed run --resume {0} completes it)",
                    name));
  }
  return spare;
}

}  // namespace harness
