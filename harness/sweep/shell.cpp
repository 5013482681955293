#include "harness/sweep/shell.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
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

namespace {

/// Starts a program without a shell, with its standard output on this descriptor. -1 and errno if this fails.
pid_t started(const std::vector<std::string>& arguments, int output) {
  std::vector<char*> words;
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  pid_t process = -1;
  const int error = posix_spawnp(&process, words.front(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  errno = error;
  return error == 0 ? process : -1;
}

}  // namespace

std::string output_of(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t process = started(arguments, ends[1]);
  const int error = errno;
  close(ends[1]);
  std::string output;
  std::array<char, 4096> block{};
  for (ssize_t count = 0; process > 0; output.append(block.data(), static_cast<std::size_t>(count))) {
    count = read(ends[0], block.data(), block.size());
    if (count < 0 && errno == EINTR)
      count = 0;
    else if (count <= 0)
      break;
  }
  close(ends[0]);
  if (process < 0 && error == ENOENT)
    throw std::runtime_error(fmt::format("there is no program {} here", arguments.front()));
  if (process < 0)
    throw std::system_error(error, std::generic_category(), "cannot start " + arguments.front());
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0) throw std::runtime_error(fmt::format("{} failed", arguments.front()));
  return output;
}

}  // namespace harness
