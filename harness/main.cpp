// The program `seifbed`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "harness/commands.hpp"
#include "harness/registry.hpp"
#include "harness/version.hpp"

int main(int argc, char** argv) {
  const seif::Registry registry = harness::known_estimators();

  CLI::App app("A robot testbed: worlds are simulated, estimators run live in them and are scored.",
               "seifbed");
  app.set_version_flag("--version", fmt::format("seifbed {}", harness::program_version()));
  app.require_subcommand(1);
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
  harness::add_schema(line);
  harness::add_estimators(line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Zero for --help and --version; everything else is a command line that cannot be understood.
    return app.exit(error) == 0 ? 0 : 2;
  }
  return exit_code;
}
