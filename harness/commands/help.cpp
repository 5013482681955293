#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "harness/commands/call_errors.hpp"
#include "harness/commands/commands.hpp"
#include "harness/files/bad_input.hpp"
#include "worlds/suggestion.hpp"

namespace harness {

namespace {

int print_help(const CLI::App& app, const std::string& name) {
  const std::string program = app.get_name();
  if (name.empty())
    return print_all(app.get_formatter()->make_help(&app, program, CLI::AppFormatMode::Normal), 0);
  const std::vector<std::string> names = command_names(app);
  if (std::ranges::find(names, name) == names.end())
    throw BadInput(fmt::format("seifbed help: there is no command '{}'{}\nseifbed help lists them.", name,
                               worlds::suggestion(name, names)));
  return print_all(app.get_subcommand(name)->help(program), 0);
}

}  // namespace

void add_help(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("help", "Print the help of the program, or of a command");
  command->footer(
      "Examples:\n"
      "  seifbed help\n"
      "  seifbed help run");
  auto name = std::make_shared<std::string>();
  command->add_option("COMMAND", *name, "The command; by default all are listed");
  command->callback([=, &app = line.app, &code = line.exit_code] {
    code = guarded([&] { return print_help(app, *name); });
  });
}

}  // namespace harness
