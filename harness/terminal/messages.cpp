#include "harness/terminal/messages.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace harness {

namespace {

/// A character of a text in UTF-8. No length: there is none.
struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  // [byte]
};

Character character_at(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (length == 1) return {byte(0), 1};
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return {};
  std::uint32_t code = byte(0) & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  const std::uint32_t smallest = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return code < smallest || code > 0x10ffff || is_surrogate ? Character{} : Character{code, length};
}

/// Control characters, and those that turn the direction of writing.
bool is_control(std::uint32_t code) {
  if (code == '\n' || code == '\t') return false;
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x200e || code == 0x200f ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

constexpr std::string_view red = "\033[31m", yellow = "\033[33m", usual = "\033[0m";

/// True for the lines of the scoreboard and of doctor that do.
bool tells_of_a_fault(std::string_view line) {
  const std::array<std::string_view, 4> faults = {"  BAD ", " diverged ", " failed ",
                                                  " had no positive definite belief "};
  return std::ranges::any_of(
      faults, [&](std::string_view fault) { return line.find(fault) != std::string_view::npos; });
}

/// An error shows in std::ferror.
void write_to_stdout(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

void tell_in(std::string_view colour, std::string_view message) {
  const bool is_coloured = shows_colours(STDERR_FILENO);
  write_to_stderr(
      fmt::format("{}{}{}\n", is_coloured ? colour : "", printable(message), is_coloured ? usual : ""));
}

}  // namespace

void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free number is taken. Opened for reading, it refuses to be written.
    static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character character = character_at(text);
    if (character.length == 0) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
      text.remove_prefix(1);
      continue;
    }
    if (is_control(character.code)) {
      result += fmt::format("\\u{:04x}", character.code);
    } else {
      result += text.substr(0, character.length);
    }
    text.remove_prefix(character.length);
  }
  return result;
}

bool shows_colours(int stream) {
  const char* const refused = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  if (refused != nullptr && *refused != '\0') return false;
  if (terminal == nullptr || *terminal == '\0' || std::string_view(terminal) == "dumb") return false;
  return ::isatty(stream) == 1;
}

void tell(std::string_view message) { write_to_stderr(printable(message) + '\n'); }
void tell_warning(std::string_view message) { tell_in(yellow, message); }
void tell_error(std::string_view message) { tell_in(red, message); }

void write_to_stderr(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr) == text.size());
  std::fflush(stderr);
}

void print_out(std::string_view text) {
  write_to_stdout(printable(text));
  std::fflush(stdout);
}

void print_board(std::string_view text) {
  const bool is_coloured = shows_colours(STDOUT_FILENO);
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, length);
    text.remove_prefix(length);
    if (is_coloured && tells_of_a_fault(line)) {
      write_to_stdout(fmt::format("{}{}{}", red, printable(line), usual));
    } else {
      write_to_stdout(printable(line));
    }
  }
  std::fflush(stdout);
}

void print_data(std::string_view text) {
  if (::isatty(STDOUT_FILENO) == 1) return print_out(text);
  write_to_stdout(text);
  std::fflush(stdout);
}

int finish_output(int exit_code) {
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::ferror(stdout) == 0) return exit_code;
  tell_error("seifbed: cannot write to the standard output");
  return exit_code == 0 ? 1 : exit_code;
}

}  // namespace harness
