// What is wrong with a call of the program, and what was meant.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace harness {

/// The names of the commands, in the order of the help.
std::vector<std::string> command_names(const CLI::App& app);

/// The names of a command's options, such as --seed or -o.
std::vector<std::string> option_names(const CLI::App& command);

/// The message for a call that could not be parsed.
std::string explain(const CLI::App& app, const CLI::ParseError& error);

}  // namespace harness
