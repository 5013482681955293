// Runs the program as a separate process, which can be measured, and killed at any time.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace harness::test {

struct Ended {
  int exit_code = 0;         // -1: a signal ended it
  double cpu_seconds = 0.0;  // [s] over all threads
  double peak_bytes = 0.0;   // [byte] resident
};

/// `seifbed` with these arguments in a folder. Its output goes to the files `output` and `errors` there.
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

/// Whether this program is built with the address sanitizer, which needs additional memory and time.
bool is_sanitized();

}  // namespace harness::test
