// The program `seifbed`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/commands/call_errors.hpp"
#include "harness/commands/commands.hpp"
#include "harness/estimators/plugins.hpp"
#include "harness/estimators/registry.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/messages.hpp"
#include "harness/terminal/version.hpp"
#include "worlds/limits.hpp"

namespace {

void raise_limits(double factor) {
  try {
    worlds::raise_limits(factor);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("--limits", error.what());
  }
}

/// In this process and in those that it starts.
void use_plugin(const std::string& library, seif::Registry& registry) {
  if (harness::pass_on_plugin(library)) harness::add_plugin(library, registry);
}

void add_commands(const harness::CommandLine& line) {
  harness::add_run(line);
  harness::add_live(line);
  harness::add_replay(line);
  harness::add_calibrate(line);
  harness::add_score(line);
  harness::add_export(line);
  harness::add_film(line);
  harness::add_report(line);
  harness::add_compare(line);
  harness::add_paper(line);
  harness::add_stress(line);
  harness::add_sweep(line);
  harness::add_merge(line);
  harness::add_validate(line);
  harness::add_doctor(line);
  harness::add_schema(line);
  harness::add_estimators(line);
  harness::add_help(line);
  harness::add_completion(line);
  harness::add_man(line);
}

int call(int argc, char** argv) {
  seif::Registry registry = harness::known_estimators();
  harness::add_plugins_of_environment(registry);
  CLI::App app("A robot testbed: worlds are simulated, estimators run live in them and are scored.",
               "seifbed");
  app.set_version_flag("--version", fmt::format("seifbed {}", harness::program_version()),
                       "Print the version, and exit");
  app.require_subcommand(1);
  app.add_option_function<double>(
         "--limits", raise_limits,
         "Let files ask for so many times more than usual: landmarks, values, bytes, tries. It stands before "
         "the command: seifbed --limits 4 run WORLD")
      ->check(harness::number_between(1.0, 100.0));
  app.add_option_function<std::vector<std::string>>(
         "--plugin",
         [&registry](const std::vector<std::string>& libraries) {
           for (const std::string& library : libraries) use_plugin(library, registry);
         },
         "Load estimators of your own from a shared library (docs/plugins.md). It stands before the command, "
         "and may stand several times: seifbed --plugin ./libmine.so run WORLD")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.footer("Each command says more: seifbed run --help, or seifbed help run");
  int exit_code = 0;
  add_commands({app, registry, exit_code});
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help and --version
    std::ostringstream text;
    app.exit(wanted, text);
    harness::print_out(text.str());
  } catch (const CLI::ParseError& error) {
    harness::tell_error(harness::explain(app, error));
    return 2;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A closed pipe or a file-size limit must give an error message, not kill the program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  harness::hold_standard_streams();
  return harness::finish_output(harness::guarded([&] { return call(argc, argv); }));
}
