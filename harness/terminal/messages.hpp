// What the program says to its user. Messages go to stderr, results to stdout. Characters of the input can do
// nothing to the terminal, and a stream that cannot be written ends nothing.
#pragma once

#include <string>
#include <string_view>

namespace harness {

/// Opens /dev/null for each of stdin, stdout and stderr that is closed. Otherwise the next file that is opened
/// would take its place, and receive what is printed. Writing to such a stdout or stderr still fails.
void hold_standard_streams();

/// The text with escapes in place of control characters and of bytes that are not UTF-8. Line ends and tabs stay.
std::string printable(std::string_view text);

/// True if this stream (STDOUT_FILENO, STDERR_FILENO) is a terminal that shows colours and nothing
/// (https://no-color.org, TERM=dumb) speaks against them.
bool shows_colours(int stream);

/// Prints a line to stderr, printable: plain, in yellow or in red. Nothing happens if stderr cannot be written.
void tell(std::string_view message);
void tell_warning(std::string_view message);
void tell_error(std::string_view message);

/// Writes to stderr as it is: nothing happens if that fails.
void write_to_stderr(std::string_view text);

/// Prints to stdout, printable. An error is kept for finish_output().
void print_out(std::string_view text);
/// The same; lines that say that something went wrong are red on a terminal that shows colours.
void print_board(std::string_view text);
/// Prints data to stdout as it is, unless stdout is a terminal.
void print_data(std::string_view text);

/// To be called at the end: flushes stdout, and says so if anything could not be written. Returns `exit_code`,
/// or 1 instead of 0 if the output is not whole.
int finish_output(int exit_code);

}  // namespace harness
