#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "harness/commands/command_table.hpp"
#include "harness/commands/commands.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

/// Text of a man page: a backslash, a dash, and a dot at the beginning of a line mean something there.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

std::string option_text(const OptionEntry& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
  if (!option.value.empty())
    names += fmt::format("{}\\fI{}\\fR", names.empty() ? "" : " ", roff(option.value));
  std::string text = fmt::format(".TP\n{}\n{}\n", names, roff(option.help));
  if (!option.choices.empty())
    text += fmt::format("One of: {}.\n", roff(fmt::format("{}", fmt::join(option.choices, ", "))));
  return text;
}

std::string command_text(const CommandEntry& command) {
  std::string text = fmt::format(".SS seifbed {}\n{}.\n", roff(command.name), roff(command.help));
  const auto is_unnamed = [](const OptionEntry& option) { return option.names.empty(); };
  std::vector<OptionEntry> options = command.options;
  std::ranges::stable_partition(options, is_unnamed);
  for (const OptionEntry& option : options) text += option_text(option);
  if (!command.footer.empty()) text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.footer));
  return text;
}

std::string man_page(const std::vector<CommandEntry>& table) {
  std::string text = fmt::format(
      ".TH SEIFBED 1 \"\" \"seifbed {}\" \"User commands\"\n"
      ".SH NAME\n"
      "seifbed \\- {}\n"
      ".SH SYNOPSIS\n"
      ".B seifbed\n"
      "[\\fB\\-\\-limits\\fR \\fIN\\fR] [\\fB\\-\\-plugin\\fR \\fIFILE\\fR ...] \\fICOMMAND\\fR "
      "[\\fIOPTION\\fR ...]\n"
      ".SH OPTIONS\n",
      roff(program_version()), roff(table.front().help));
  for (const OptionEntry& option : table.front().options) text += option_text(option);
  text += ".SH COMMANDS\n";
  for (auto command = std::next(table.begin()); command != table.end(); ++command)
    text += command_text(*command);
  return text +
         ".SH EXIT STATUS\n"
         ".TP\n0\nAll is well.\n"
         ".TP\n1\nA run failed, or something could not be written.\n"
         ".TP\n2\nThe input is not right: the command line, a world file, a log.\n"
         ".TP\n130\nInterrupted; what there is was written.\n"
         ".SH ENVIRONMENT\n"
         ".TP\n\\fBNO_COLOR\\fR\nIf it is not empty, messages have no colours.\n"
         ".TP\n\\fBSEIFBED_PLUGINS\\fR\nPlug-ins that every command loads; paths with ':' between them.\n"
         ".TP\n\\fBTMPDIR\\fR\nWhere temporary files are; by default /tmp.\n";
}

}  // namespace

void add_man(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("man", "Print the man page of the program");
  command->footer(
      "Examples:\n"
      "  seifbed man | man -l -\n"
      "  seifbed man > ~/.local/share/man/man1/seifbed.1");
  command->callback([&app = line.app, &code = line.exit_code] {
    code = guarded([&] { return print_all(man_page(command_table(app)), 0); });
  });
}

}  // namespace harness
