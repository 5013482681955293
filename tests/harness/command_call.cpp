#include "command_call.hpp"

#include <sys/wait.h>

#include <cstdio>
#include <stdexcept>

#include "fixtures.hpp"

namespace harness::test {

Called call_program(const TemporaryFolder& folder, const std::string& line) {
  const std::string command = "cd '" + folder.path().string() + "' && " + line + " 2>errors";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot call the program");
  Called called;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) called.output += static_cast<char>(c);
  called.exit_code = WEXITSTATUS(pclose(pipe));
  called.errors = read_file(folder / "errors");
  return called;
}

Called call(const TemporaryFolder& folder, const std::string& arguments, const std::string& environment) {
  return call_program(folder, environment + " '" SEIFBED_PROGRAM "' " + arguments);
}

}  // namespace harness::test
