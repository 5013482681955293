#include "harness/figures/piped_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace harness {

namespace {

void check(bool good, const char* what) {
  if (!good) throw std::system_error(errno, std::generic_category(), what);
}

void check_spawn(int error, const std::string& program) {
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot start " + program);
}

/// The settings with which a new process starts.
class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  void set_streams(int input, int errors) {
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }

  void set_own_group() {
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }

  pid_t spawn(const std::vector<std::string>& arguments) const {
    std::vector<char*> words;
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    pid_t process = -1;
    check_spawn(posix_spawnp(&process, words.front(), &actions_, &attributes_, words.data(), environ),
                arguments.front());
    return process;
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// poll() that continues after a signal.
void wait_for(std::span<pollfd> descriptors) {
  while (poll(descriptors.data(), descriptors.size(), -1) < 0) check(errno == EINTR, "cannot poll");
}

bool is_only_delay(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

void Descriptor::reset(int number) {
  if (number_ >= 0) close(number_);
  number_ = number;
}

// A socket instead of a pipe: send() can be told not to raise SIGPIPE.
PipedProgram::PipedProgram(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  check(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0, "cannot make a socket");
  input_.reset(ends[0]);
  const Descriptor its_input(ends[1]);
  check(pipe2(ends.data(), O_CLOEXEC) == 0, "cannot make a pipe");
  errors_.reset(ends[0]);
  const Descriptor its_errors(ends[1]);
  SpawnSettings settings;
  settings.set_streams(its_input.number(), its_errors.number());
  settings.set_own_group();
  process_ = settings.spawn(arguments);
}

PipedProgram::~PipedProgram() {
  try {
    static_cast<void>(finish());
  } catch (const std::system_error&) {  // there is nothing left to wait for
  }
}

// Reads the program's stderr while sending. Otherwise a program that writes much would block, and so would
// we.
bool PipedProgram::send(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    std::array<pollfd, 2> descriptors{{{input_.number(), POLLOUT, 0}, {errors_.number(), POLLIN, 0}}};
    wait_for(descriptors);
    if (descriptors[1].revents != 0 && !read_complaint()) return false;
    if (descriptors[0].revents == 0) continue;
    const ssize_t sent = ::send(input_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && !is_only_delay(errno)) return false;
    if (sent > 0) bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool PipedProgram::finish() {
  if (process_ < 0) return succeeded_;
  input_.reset();
  while (read_complaint()) {
  }
  int status = 0;
  while (waitpid(process_, &status, 0) < 0) check(errno == EINTR, "cannot wait for a program");
  process_ = -1;
  succeeded_ = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return succeeded_;
}

bool PipedProgram::read_complaint() {
  constexpr std::size_t longest = 4096;
  std::array<char, 1024> buffer{};
  const ssize_t count = read(errors_.number(), buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR;
  const std::size_t room = longest - complaint_.size();
  complaint_.append(buffer.data(), std::min(static_cast<std::size_t>(count), room));
  return count > 0;
}

}  // namespace harness
