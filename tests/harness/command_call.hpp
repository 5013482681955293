// Calls the program on the command line.
#pragma once

#include <string>

#include "harness/recording/run_folder.hpp"

namespace harness::test {

struct Called {
  int exit_code = 0;
  std::string output;
  std::string errors;
};

/// Runs a line of the shell inside a folder. Throws std::runtime_error if that cannot be done.
Called call_program(const TemporaryFolder& folder, const std::string& line);

/// Calls `seifbed`, with variables of the environment such as "A=1 B=2".
Called call(const TemporaryFolder& folder, const std::string& arguments, const std::string& environment = "");

}  // namespace harness::test
