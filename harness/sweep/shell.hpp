// Calls programs and returns what they print.
#pragma once

#include <string>
#include <vector>

namespace harness {

/// A word quoted for a shell, whatever characters it has.
std::string shell_quoted(const std::string& word);

/// Runs a program, found along PATH, and waits for its end; what it prints to stderr goes to ours. Returns
/// what it prints to stdout. Throws std::runtime_error, which names it, if it is not there or fails.
std::string output_of(const std::vector<std::string>& arguments);

}  // namespace harness
