// The commands of the program. Each adds itself to the command line and, if it was called, runs with the exit
// code: 0 fine, 1 a run that failed, 2 bad input, 130 interrupted.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/run/prepared_run.hpp"
#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// What every command is handed.
struct CommandLine {
  CLI::App& app;
  const seif::Registry& registry;
  int& exit_code;  // of the command that ran
};

void add_run(CommandLine line);
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

/// Prints each problem as a line of stderr, sorted by place.
void print_problems(std::vector<worlds::Problem> problems);

/// Runs a command; what it throws is printed, and becomes an exit code.
int guarded(const std::function<int()>& command);

/// Where a run goes, and what is printed of it.
struct OutputArguments {
  std::string out;  // a folder; empty: a new one in runs/
  bool json = false;
  bool quiet = false;
};

/// --format, --robot, --truth and --noise.
void add_log_options(CLI::App& command, LogChoice& log);

/// For the help: `folder` is what --out is by default, `printed` what --json prints, and instead of what.
void add_output_options(CLI::App& command, OutputArguments& output, const std::string& folder,
                        const std::string& printed = "summary.json instead of the scoreboard");

/// The folder that --out asks for, or by default a new one, runs/`name`.
std::filesystem::path make_folder(const OutputArguments& output, const std::string& name);

/// Makes the folder of a run, by default runs/`name`, and puts it into the plan.
void open_folder(PreparedRun& run, const OutputArguments& output, const std::string& name);

/// Tells how a run ended: its error, and the summary as JSON or as a scoreboard. The exit code.
int print_result(const RunResult& result, const std::filesystem::path& folder, const OutputArguments& output);

/// Prints what came of it as JSON, or as a board with the folder to which it was written, or nothing, as was
/// asked. The exit code, as print_all() keeps it.
int print_output(const OutputArguments& output, const std::string& json, const std::string& board,
                 const std::filesystem::path& folder, int exit_code);

/// Prints to stdout. The exit code is kept, unless that cannot be written.
int print_all(const std::string& text, int exit_code);

}  // namespace harness
