#include "harness/commands/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "harness/files/bad_input.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/score/scoreboard.hpp"

namespace harness {

void print_problems(std::vector<worlds::Problem> problems) {
  constexpr std::size_t most = 50;  // [-] more would not be read
  worlds::sort_by_place(problems);
  for (std::size_t i = 0; i < std::min(most, problems.size()); ++i)
    fmt::print(stderr, "{}\n", worlds::to_string(problems[i]));
  if (problems.size() > most) fmt::print(stderr, "... and {} problems more\n", problems.size() - most);
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

void add_log_options(CLI::App& command, LogChoice& log) {
  command.add_option("--format", log.format, "Format of the log; by default told by its content")
      ->check(CLI::IsMember(log_format_names()));
  command.add_option("--robot", log.robot, "Which robot of an MRCLAM folder; 1 by default")
      ->check(CLI::PositiveNumber);
  command.add_option("--truth", log.truth, "The same graph without noise, for the scores")->type_name("FILE");
  command
      .add_option("--noise", log.noise.file,
                  "YAML with the noise of odometry and sensor, as seifbed calibrate prints it")
      ->type_name("FILE");
}

void add_output_options(CLI::App& command, OutputArguments& output, const std::string& folder,
                        const std::string& printed) {
  command.add_option("--out", output.out, "Folder to write to; by default a new one, " + folder);
  command.add_flag("--json", output.json, "Print " + printed);
  command.add_flag("--quiet", output.quiet, "Print errors only");
}

std::filesystem::path make_folder(const OutputArguments& output, const std::string& name) {
  return output.out.empty() ? create_run_folder("runs", name) : create_empty_folder(output.out);
}

void open_folder(PreparedRun& run, const OutputArguments& output, const std::string& name) {
  run.plan.folder = make_folder(output, name);
  run.plan.quiet = output.quiet || output.json;
}

int print_result(const RunResult& result, const std::filesystem::path& folder,
                 const OutputArguments& output) {
  if (!result.error.empty()) fmt::print(stderr, "{}\n", result.error);
  if (result.bad_input) {
    if (result.is_void) std::filesystem::remove_all(folder);
    if (!result.is_void && !output.quiet)
      fmt::print(stderr, "seifbed: {} holds the run up to there, marked as interrupted\n", folder.string());
    return exit_code(result);
  }
  return print_output(output, to_json(result.summary), scoreboard(result.summary), folder, exit_code(result));
}

int print_output(const OutputArguments& output, const std::string& json, const std::string& board,
                 const std::filesystem::path& folder, int exit_code) {
  if (output.json) return print_all(json, exit_code);
  if (output.quiet) return exit_code;
  return print_all(fmt::format("{}\nWritten to {}\n", board, folder.string()), exit_code);
}

int print_all(const std::string& text, int exit_code) {
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_written && std::fflush(stdout) == 0) return exit_code;
  fmt::print(stderr, "seifbed: cannot write to the standard output\n");
  return 1;
}

}  // namespace harness
