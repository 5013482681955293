// The program as a process of its own: measured, and killed at will.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace harness::test {

struct Ended {
  int exit_code = 0;         // -1: a signal ended it
  double cpu_seconds = 0.0;  // [s] of all its threads
  double peak_bytes = 0.0;   // [byte] resident
};

/// `seifbed` with these arguments in a folder; what it prints goes to the files `output` and `errors` there.
class Process {
 public:
  Process(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~Process();  // kills it
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  Ended wait();

 private:
  pid_t process_ = -1;
};

/// Whether this is built with the address sanitizer, which takes memory and time of its own.
bool is_sanitized();

}  // namespace harness::test
