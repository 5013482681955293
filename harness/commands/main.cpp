// The program `seifbed`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "harness/commands/commands.hpp"
#include "harness/estimators/registry.hpp"
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

}  // namespace

int main(int argc, char** argv) {
  // A closed pipe or a file-size limit must give an error message, not kill the program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const seif::Registry registry = harness::known_estimators();

  CLI::App app("A robot testbed: worlds are simulated, estimators run live in them and are scored.",
               "seifbed");
  app.set_version_flag("--version", fmt::format("seifbed {}", harness::program_version()));
  app.require_subcommand(1);
  app.add_option_function<double>(
      "--limits", raise_limits,
      "Let files ask for so many times more than usual: landmarks, values, bytes, "
      "tries; before the command");
  app.footer("Each command says more: seifbed run --help");
  int exit_code = 0;
  const harness::CommandLine line{app, registry, exit_code};
  harness::add_run(line);
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Zero for --help and --version; any other parse error is bad input.
    return app.exit(error) == 0 ? 0 : 2;
  }
  return exit_code;
}
