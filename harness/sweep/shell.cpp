#include "harness/sweep/shell.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace harness {

std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string output_of(const std::vector<std::string>& arguments) {
  std::string line;
  for (const std::string& argument : arguments) line += shell_quoted(argument) + ' ';
  FILE* pipe = popen(line.c_str(), "re");
  if (pipe == nullptr)
    throw std::system_error(errno, std::generic_category(), "cannot start " + arguments.front());
  std::string output;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe))
    output.append(block.data(), count);
  const int status = pclose(pipe);
  constexpr int not_found = 127;  // of a shell
  if (WIFEXITED(status) && WEXITSTATUS(status) == not_found)
    throw std::runtime_error(fmt::format("there is no program {} here", arguments.front()));
  if (status != 0) throw std::runtime_error(fmt::format("{} failed", arguments.front()));
  return output;
}

}  // namespace harness
