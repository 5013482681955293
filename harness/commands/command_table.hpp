// The commands and options as a table, from which the man page and the shell completion are made.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace harness {

struct OptionEntry {
  std::vector<std::string> names;    // such as --seed; empty: a word without a name
  std::string value;                 // what stands behind it, such as INT; empty: it is a flag
  std::vector<std::string> choices;  // the words that are allowed; empty: any
  std::string help;
};

struct CommandEntry {
  std::string name;
  std::string help;
  std::string footer;                // examples
  std::vector<OptionEntry> options;  // with the words without names
};

/// The program itself comes first.
std::vector<CommandEntry> command_table(const CLI::App& app);

}  // namespace harness
