#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/commands/command_table.hpp"
#include "harness/commands/commands.hpp"
#include "harness/terminal/checks.hpp"

namespace harness {

namespace {

std::string replaced(std::string_view text, std::string_view letters, std::string_view escape) {
  std::string result;
  for (const char c : text) {
    if (letters.find(c) != std::string_view::npos) result += escape;
    result += c;
  }
  return result;
}

std::string names_in(const std::vector<CommandEntry>& commands) {
  std::vector<std::string> names;
  for (auto command = std::next(commands.begin()); command != commands.end(); ++command)
    names.push_back(command->name);
  return fmt::format("{}", fmt::join(names, " "));
}

/// What follows the option that stands before the cursor: words, or files for an option with any value.
std::string bash_values(const CommandEntry& command, const std::string& commands) {
  std::string text;
  for (const OptionEntry& option : command.options) {
    if (option.value.empty() || option.names.empty()) continue;
    text += fmt::format("        {}) wanted='{}'; has_value=1 ;;\n", fmt::join(option.names, "|"),
                        fmt::join(option.choices, " "));
  }
  if (command.name == "help") text += fmt::format("        help) wanted='{}' ;;\n", commands);
  for (const OptionEntry& option : command.options) {
    if (option.names.empty() && !option.choices.empty())
      text += fmt::format("        {}) wanted='{}' ;;\n", command.name, fmt::join(option.choices, " "));
  }
  return text.empty() ? "" : fmt::format("      case $before in\n{}      esac\n", text);
}

std::string bash_options(const CommandEntry& command) {
  std::vector<std::string> names;
  for (const OptionEntry& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

std::string bash_script(const std::vector<CommandEntry>& table) {
  const std::string commands = names_in(table);
  std::string text =
      "# Completion of seifbed for bash: source <(seifbed completion bash)\n"
      "_seifbed() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  local command= options= wanted= has_value= i\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    case ${COMP_WORDS[i]} in\n"
      "      --limits|--plugin) ((++i)) ;;\n"
      "      -*) ;;\n"
      "      *) command=${COMP_WORDS[i]}; break ;;\n"
      "    esac\n"
      "  done\n"
      "  case $command in\n";
  for (const CommandEntry& command : table) {
    const bool is_program = &command == &table.front();
    text += fmt::format("    {})\n      options='{}'\n{}{}      ;;\n", is_program ? "''" : command.name,
                        bash_options(command),
                        is_program ? fmt::format("      wanted='{}'\n", commands) : std::string(),
                        bash_values(command, commands));
  }
  text +=
      "  esac\n"
      "  COMPREPLY=()\n"
      "  if [[ $word == -* && -z $has_value ]]; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
      "  elif [[ -n $wanted ]]; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"$wanted\" -- \"$word\")\n"
      "  fi\n"
      "}\n"
      "complete -o default -F _seifbed seifbed\n";
  return text;
}

/// Text inside of an argument of _arguments, in single quotes.
std::string zsh_text(std::string_view text) {
  std::string result;
  for (const char c : replaced(text, "\\[]:", "\\"))
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result;
}

std::string zsh_action(const OptionEntry& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  return option.value == "INT" || option.value == "FLOAT" || option.value == "UINT" ? " " : "_files";
}

std::string zsh_argument(const OptionEntry& option) {
  if (option.names.empty())
    return fmt::format(" \\\n        '*:{}:{}'", zsh_text(option.value), zsh_action(option));
  std::string text;
  for (const std::string& name : option.names) {
    text += fmt::format(" \\\n        '*{}[{}]", name, zsh_text(option.help));
    if (!option.value.empty()) text += fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
    text += '\'';
  }
  return text;
}

std::string zsh_script(const std::vector<CommandEntry>& table) {
  std::string text =
      "#compdef seifbed\n"
      "# Completion of seifbed for zsh: seifbed completion zsh > FOLDER/_seifbed, a folder of $fpath\n"
      "_seifbed() {\n"
      "  local -a commands=(\n";
  for (auto command = std::next(table.begin()); command != table.end(); ++command)
    text += fmt::format("    '{}:{}'\n", command->name, zsh_text(command->help));
  text += "  )\n  local context state state_descr line\n  typeset -A opt_args\n  _arguments -C";
  for (const OptionEntry& option : table.front().options) text += zsh_argument(option);
  text +=
      " \\\n        '1: :->command' '*:: :->argument'\n"
      "  [[ $state == command ]] && _describe command commands\n"
      "  [[ $state == argument ]] || return 0\n"
      "  case $words[1] in\n";
  for (auto command = std::next(table.begin()); command != table.end(); ++command) {
    text += fmt::format("    {})\n      _arguments", command->name);
    for (const OptionEntry& option : command->options) {
      OptionEntry shown = option;
      if (command->name == "help" && option.value == "COMMAND") shown.choices = {names_in(table)};
      text += zsh_argument(shown);
    }
    text += "\n      ;;\n";
  }
  return text +
         "  esac\n}\nif [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n  _seifbed \"$@\"\nelse\n"
         "  compdef _seifbed seifbed\nfi\n";
}

}  // namespace

void add_completion(CommandLine line) {
  CLI::App* command =
      line.app.add_subcommand("completion", "Print a script that completes commands and options in a shell");
  command->footer(
      "Examples:\n"
      "  source <(seifbed completion bash)       # a line for ~/.bashrc\n"
      "  seifbed completion zsh > ~/.zfunc/_seifbed\n"
      "docs/command_line.md says how to install it.");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash or zsh")->required()->check(one_of({"bash", "zsh"}));
  command->callback([=, &app = line.app, &code = line.exit_code] {
    const std::vector<CommandEntry> table = command_table(app);
    code = guarded([&] { return print_all(*shell == "bash" ? bash_script(table) : zsh_script(table), 0); });
  });
}

}  // namespace harness
