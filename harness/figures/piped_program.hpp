// Another program that reads our data from its standard input.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace harness {

/// A file descriptor that is closed with the object.
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

/// The program runs without a shell, in its own process group, so Ctrl-C in the terminal does not reach it.
/// When we end for any reason, its input ends and it can finish its work.
class PipedProgram {
 public:
  /// Starts a program, searched for along PATH, with its arguments. Throws std::system_error if this fails;
  /// the code is std::errc::no_such_file_or_directory if there is no such program.
  explicit PipedProgram(const std::vector<std::string>& arguments);

  /// Waits for the program's end.
  ~PipedProgram();

  /// Sends these bytes to the program's standard input. False if the program ended before it had read all of
  /// them.
  [[nodiscard]] bool send(std::span<const std::uint8_t> bytes);

  /// Closes the program's input and waits for its end. False if the program failed.
  [[nodiscard]] bool finish();

  /// The beginning of the program's output to stderr.
  const std::string& complaint() const { return complaint_; }

 private:
  /// Reads what the program has written to stderr. False at the end.
  bool read_complaint();

  Descriptor input_;   // its stdin, a socket
  Descriptor errors_;  // its stderr
  pid_t process_ = -1;
  bool succeeded_ = false;
  std::string complaint_;
};

}  // namespace harness
