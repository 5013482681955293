// Another program that reads what we send it.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace harness {

/// A descriptor of the system that is closed with the object.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  void reset(int number = -1);

 private:
  int number_ = -1;
};

/// Runs without a shell, in a process group of its own: Ctrl-C at the terminal does not reach it. When we
/// end, however that comes, it finds the end of its input, and finishes its work.
class PipedProgram {
 public:
  /// The name of the program, looked for along PATH, and its arguments. Throws std::system_error if it cannot
  /// be started; its code is std::errc::no_such_file_or_directory if there is no such program.
  explicit PipedProgram(const std::vector<std::string>& arguments);

  /// Waits for its end.
  ~PipedProgram();

  /// Hands these bytes to its standard input. False if it does not read them all, because it has ended.
  [[nodiscard]] bool send(std::span<const std::uint8_t> bytes);

  /// Ends its input and waits for its end. False if it failed.
  [[nodiscard]] bool finish();

  /// The beginning of what it has written to stderr.
  const std::string& complaint() const { return complaint_; }

 private:
  /// Takes in what is there to be read from its stderr. False at the end.
  bool read_complaint();

  Descriptor input_;   // its stdin, a socket
  Descriptor errors_;  // its stderr
  pid_t process_ = -1;
  bool succeeded_ = false;
  std::string complaint_;
};

}  // namespace harness
