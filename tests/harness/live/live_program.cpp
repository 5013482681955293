#include "live_program.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "harness/fixtures.hpp"

namespace harness::test {

LiveProgram::LiveProgram(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string line =
      fmt::format("cd {} && exec {} {} > live_out 2>&1", folder.path().string(), SEIFBED_PROGRAM, arguments);
  std::string shell = "/bin/sh", option = "-c", script = line;
  char* words[] = {shell.data(), option.data(), script.data(), nullptr};
  write_file(folder / "live_out", "");
  if (posix_spawn(&process_, shell.c_str(), nullptr, nullptr, words, environ) != 0)
    throw std::runtime_error("cannot start the program");
  const std::string before = "Open ";
  for (int i = 0; i < 6000; ++i) {
    const std::string output = read_file(folder / "live_out");
    const std::size_t begin = output.find(before + "http");
    const std::size_t end = begin == std::string::npos ? begin : output.find('\n', begin);
    if (end != std::string::npos) {
      url_ = output.substr(begin + before.size(), end - begin - before.size());
      return;
    }
    if (!is_running()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error("the program has printed no address: " + read_file(folder / "live_out"));
}

LiveProgram::~LiveProgram() {
  if (process_ <= 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

std::uint16_t LiveProgram::port() const {
  const std::size_t colon = url_.find(':', std::string_view("http://").size());
  return static_cast<std::uint16_t>(std::stoi(url_.substr(colon + 1)));
}

std::string LiveProgram::socket() const { return "/socket" + url_.substr(url_.find('?')); }

bool LiveProgram::is_running() const {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == 0;
}

std::int64_t LiveProgram::resident_bytes() const {
  std::ifstream file(fmt::format("/proc/{}/statm", process_));
  std::int64_t all = 0;
  std::int64_t resident = 0;
  file >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

int LiveProgram::stop() {
  kill(process_, SIGINT);
  return wait();
}

int LiveProgram::wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace harness::test
