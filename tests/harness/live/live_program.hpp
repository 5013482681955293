// The program `seifbed live`, or `run --live`, as people start it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "harness/recording/run_folder.hpp"

namespace harness::test {

class LiveProgram {
 public:
  /// Starts `seifbed ARGUMENTS` inside the folder, and waits until it has printed an address. Throws
  /// std::runtime_error with what it said if it ends before.
  LiveProgram(const TemporaryFolder& folder, const std::string& arguments);
  ~LiveProgram();
  LiveProgram(const LiveProgram&) = delete;
  LiveProgram& operator=(const LiveProgram&) = delete;

  const std::string& url() const { return url_; }
  std::uint16_t port() const;
  /// The path of the socket, with the token.
  std::string socket() const;
  bool is_running() const;
  /// Resident memory. [byte]
  std::int64_t resident_bytes() const;

  /// Presses Ctrl-C, and returns the exit code.
  int stop();
  /// Waits until it ends by itself, and returns the exit code.
  int wait();

 private:
  pid_t process_ = -1;
  std::string url_;
};

}  // namespace harness::test
