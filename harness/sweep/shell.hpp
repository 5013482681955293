// Runs programs for their output.
#pragma once

#include <string>
#include <vector>

namespace harness {

/// The word in quotes for a shell, whatever characters it has.
std::string shell_quoted(const std::string& word);

/// Runs a program, searched for along PATH, and waits for its end. Its stderr goes to ours. Returns its
/// standard output. Throws std::runtime_error, with the program's name, if it does not exist or fails.
std::string output_of(const std::vector<std::string>& arguments);

}  // namespace harness
