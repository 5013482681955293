#include "harness/commands/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <system_error>

#include "harness/files/bad_input.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

/// Says what could not be done with which file. Returns the exit code: a place that does not exist, or that one
/// may not use, is bad input.
int tell_of(const std::filesystem::filesystem_error& error) {
  std::error_code lost;
  static_cast<void>(std::filesystem::current_path(lost));
  if (lost) {
    tell_error("seifbed: the working folder cannot be used: it was deleted or moved; change to another one");
    return 2;
  }
  const std::error_code& code = error.code();
  tell_error(
      fmt::format("{}: {}", error.path1().empty() ? "seifbed" : error.path1().string(), code.message()));
  for (const std::errc reason :
       {std::errc::permission_denied, std::errc::operation_not_permitted, std::errc::read_only_file_system,
        std::errc::no_such_file_or_directory, std::errc::not_a_directory, std::errc::file_exists}) {
    if (code == reason) return 2;
  }
  return 1;
}

}  // namespace

void print_problems(std::vector<worlds::Problem> problems) {
  constexpr std::size_t most = 50;  // [-] more would not be read
  worlds::sort_by_place(problems);
  for (std::size_t i = 0; i < std::min(most, problems.size()); ++i)
    tell_error(worlds::to_string(problems[i]));
  if (problems.size() > most) tell_error(fmt::format("... and {} problems more", problems.size() - most));
}

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const BadInput& error) {
    tell_error(error.what());
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    return tell_of(error);
  } catch (const std::exception& error) {
    tell_error(fmt::format("seifbed: {}", error.what()));
    return 1;
  } catch (...) {  // a plug-in may throw anything
    tell_error("seifbed: something was thrown that is no std::exception");
    return 1;
  }
}

void add_log_options(CLI::App& command, LogChoice& log) {
  command.add_option("--format", log.format, "Format of the log; by default told by its content")
      ->check(one_of(log_format_names()));
  command.add_option("--robot", log.robot, "Which robot of an MRCLAM folder; 1 by default")
      ->check(whole_number(1, most_robots));
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
  if (!result.error.empty()) tell_error(result.error);
  if (result.bad_input) {
    if (result.is_void) std::filesystem::remove_all(folder);
    if (!result.is_void && !output.quiet)
      tell_error(
          fmt::format("seifbed: {} holds the run up to there, marked as interrupted", folder.string()));
    return exit_code(result);
  }
  return print_output(output, to_json(result.summary), scoreboard(result.summary), folder, exit_code(result));
}

int print_output(const OutputArguments& output, const std::string& json, const std::string& board,
                 const std::filesystem::path& folder, int exit_code) {
  if (output.json) return print_all(json, exit_code);
  if (output.quiet) return exit_code;
  print_board(fmt::format("{}\nWritten to {}\n", board, folder.string()));
  return exit_code;
}

int print_all(const std::string& text, int exit_code) {
  print_out(text);
  return exit_code;
}

}  // namespace harness
