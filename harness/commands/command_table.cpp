#include "harness/commands/command_table.hpp"

#include <cstddef>

namespace harness {

namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

OptionEntry option_entry(const CLI::Option& option) {
  OptionEntry entry;
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  entry.help = option.get_description();
  if (option.get_items_expected_max() == 0) return entry;
  const std::string type = option.get_type_name();  // such as INT, or TEXT:{a,b}
  const std::size_t colon = type.find(":{");
  entry.value = entry.names.empty() ? option.get_name() : type.substr(0, colon);
  if (colon != std::string::npos && type.ends_with('}'))
    entry.choices = split(type.substr(colon + 2, type.size() - colon - 3));
  return entry;
}

CommandEntry command_entry(const CLI::App& command) {
  CommandEntry entry{command.get_name(), command.get_description(), command.get_footer(), {}};
  for (const CLI::Option* option : command.get_options()) entry.options.push_back(option_entry(*option));
  return entry;
}

}  // namespace

std::vector<CommandEntry> command_table(const CLI::App& app) {
  std::vector<CommandEntry> table = {command_entry(app)};
  for (const CLI::App* command : app.get_subcommands(nullptr)) table.push_back(command_entry(*command));
  return table;
}

}  // namespace harness
