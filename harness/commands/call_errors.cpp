#include "harness/commands/call_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "worlds/suggestion.hpp"

namespace harness {

namespace {

/// An option that a command does not have, with what to use instead.
struct Hint {
  std::string_view command;  // empty: of all commands
  std::string_view option;
  std::string_view instead;
};

constexpr std::string_view one_seed =
    "this takes one seed: --seed 7; many seeds: seifbed compare WORLD --seeds 1..20, or seifbed sweep";
constexpr std::string_view has_seed =
    "a run has its seed from the time when it ran: seifbed run WORLD --seed 7";

constexpr std::array<Hint, 21> hints = {{
    {"", "--plugin", "it stands before the command: seifbed --plugin ./libmine.so run WORLD"},
    {"", "--limits", "it stands before the command: seifbed --limits 4 run WORLD"},
    {"run", "--seeds", one_seed},
    {"replay", "--seeds", "a log is recorded; --seed is of the estimators that draw"},
    {"stress", "--seeds", "this takes one seed: --seed 7"},
    {"validate", "--seed", "--set seed=7 sets it"},
    {"validate", "--seeds", "--set seed=7 sets one; a world with one seed is as valid as with another"},
    {"score", "--seed", has_seed},
    {"score", "--seeds", has_seed},
    {"export", "--seed", has_seed},
    {"export", "--seeds", has_seed},
    {"film", "--seed", has_seed},
    {"film", "--seeds", has_seed},
    {"report", "--seed", has_seed},
    {"report", "--seeds", has_seed},
    {"calibrate", "--seed", "nothing is random in it"},
    {"calibrate", "--seeds", "nothing is random in it"},
    {"merge", "--seed", "the shards have their seeds from seifbed sweep"},
    {"merge", "--seeds", "the shards have their seeds from seifbed sweep"},
    {"film", "--out", "-o FILE says where to write"},
    {"film", "--duration", "--from and --to say which part is filmed"},
}};

std::string_view hint(std::string_view command, std::string_view option) {
  const auto* const found = std::ranges::find_if(hints, [&](const Hint& one) {
    return one.option == option && (one.command.empty() || one.command == command);
  });
  return found == hints.end() ? std::string_view{} : found->instead;
}

bool is_option(std::string_view word) { return word.size() > 1 && word.front() == '-'; }

/// A message about words that nothing could be made of.
std::string unknown_words(const CLI::App& command, const std::string& name,
                          const std::vector<std::string>& words) {
  const auto option = std::ranges::find_if(words, is_option);
  if (option == words.end()) return fmt::format("{}: '{}' is one word too many", name, words.front());
  const std::string written = option->substr(0, option->find('='));
  const std::string_view instead = hint(command.get_name(), written);
  if (!instead.empty()) return fmt::format("{}: there is no option '{}' here: {}", name, written, instead);
  return fmt::format("{}: there is no option '{}'{}", name, written,
                     worlds::suggestion(written, option_names(command)));
}

/// Whether the reason is about an option that stands before the command.
bool is_of_the_program(std::string_view reason) {
  return reason.starts_with("--limits") || reason.starts_with("--plugin");
}

std::string reason_of(const CLI::App& app, const CLI::App* command, const std::string& name,
                      const CLI::ParseError& error) {
  const int kind = error.get_exit_code();
  const bool is_about_words = kind == static_cast<int>(CLI::ExitCodes::ExtrasError) ||
                              kind == static_cast<int>(CLI::ExitCodes::RequiredError);
  const std::vector<std::string> before = app.remaining();
  if (is_about_words && !before.empty() && !is_option(before.front()))
    return fmt::format("seifbed: there is no command '{}'{}", before.front(),
                       worlds::suggestion(before.front(), command_names(app)));
  if (is_about_words && !before.empty()) return unknown_words(app, "seifbed", before);
  if (command == nullptr && is_about_words)
    return "seifbed: a command is missing, such as: seifbed run worlds/courtyard.yaml";
  if (is_about_words && !command->remaining().empty())
    return unknown_words(*command, name, command->remaining());
  const std::string reason = error.what();
  return fmt::format("{}: {}", is_of_the_program(reason) ? "seifbed" : name, reason);
}

}  // namespace

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> called = app.get_subcommands();
  const CLI::App* const command = called.empty() ? nullptr : called.front();
  const std::string name = command == nullptr ? "seifbed" : "seifbed " + command->get_name();
  return fmt::format("{}\n{} --help says more.", reason_of(app, command, name, error), name);
}

}  // namespace harness
