// The commands of the program. Each adds itself to the command line, and runs if it was called. Exit codes: 0
// success, 1 a run failed, 2 bad input, 130 interrupted.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/live/live.hpp"
#include "harness/run/prepared_run.hpp"
#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// What every command receives.
struct CommandLine {
  CLI::App& app;
  const seif::Registry& registry;
  int& exit_code;  // set by the command that ran
};

void add_run(CommandLine line);
void add_live(CommandLine line);
void add_replay(CommandLine line);
void add_calibrate(CommandLine line);
void add_score(CommandLine line);
void add_export(CommandLine line);
void add_film(CommandLine line);
void add_report(CommandLine line);
void add_compare(CommandLine line);
void add_paper(CommandLine line);
void add_stress(CommandLine line);
void add_sweep(CommandLine line);
void add_merge(CommandLine line);
void add_validate(CommandLine line);
void add_schema(CommandLine line);
void add_doctor(CommandLine line);
void add_estimators(CommandLine line);
void add_help(CommandLine line);
void add_completion(CommandLine line);
void add_man(CommandLine line);

/// Prints each problem as a line on stderr, sorted by position.
void print_problems(std::vector<worlds::Problem> problems);

/// Runs a command. An exception is printed and turned into an exit code.
int guarded(const std::function<int()>& command);

/// The output folder of a run, and what is printed.
struct OutputArguments {
  std::string out;  // output folder; empty: a new one in runs/
  bool json = false;
  bool quiet = false;
};

inline constexpr int most_robots = 1000;         // [-] of an MRCLAM folder
inline constexpr double longest_duration = 1e6;  // [s] of a world
inline constexpr int most_jobs = 256;            // [-] runs at the same time

/// Adds --format, --robot, --truth and --noise.
void add_log_options(CLI::App& command, LogChoice& log);

/// Adds --port and --bind.
void add_page_options(CLI::App& command, LiveOptions& options);

/// Adds the output options. For the help texts: `folder` is the default of --out, and `printed` says what
/// --json prints.
void add_output_options(CLI::App& command, OutputArguments& output, const std::string& folder,
                        const std::string& printed = "summary.json instead of the scoreboard");

/// Makes the folder that --out gives, or by default a new one, runs/`name`.
std::filesystem::path make_folder(const OutputArguments& output, const std::string& name);

/// Makes the folder of a run, by default runs/`name`, and enters it into the plan.
void open_folder(PreparedRun& run, const OutputArguments& output, const std::string& name);

/// Prints the result of a run: its error, and the summary as JSON or as a scoreboard. Returns the exit code.
int print_result(const RunResult& result, const std::filesystem::path& folder, const OutputArguments& output);

/// Prints a result as JSON, or as a board with the folder that it was written to, or not at all, as `output`
/// says. Returns the exit code as print_all() does.
int print_output(const OutputArguments& output, const std::string& json, const std::string& board,
                 const std::filesystem::path& folder, int exit_code);

/// Prints to stdout. Returns `exit_code`; main() finds out whether stdout could be written.
int print_all(const std::string& text, int exit_code);

}  // namespace harness
