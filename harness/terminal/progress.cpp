#include "harness/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

constexpr std::chrono::milliseconds pause{250};
constexpr const char* clear_line = "\r\033[K";

}  // namespace

StatusLine::StatusLine(bool quiet) : is_shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

StatusLine::~StatusLine() {
  if (is_shown_) write_to_stderr(clear_line);
}

bool StatusLine::is_due() {
  if (!is_shown_) return false;
  const Clock::time_point now = Clock::now();
  if (now - last_ < pause) return false;
  last_ = now;
  return true;
}

void StatusLine::show(const std::string& line) { write_to_stderr(clear_line + printable(line)); }

double StatusLine::elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

Progress::Progress(bool quiet, double start_t, std::optional<double> end_t)
    : line_(quiet), start_t_(start_t), end_t_(end_t) {}

void Progress::show(double t) {
  if (!line_.is_due()) return;
  const double factor = (t - start_t_) / line_.elapsed();
  std::string line = fmt::format("{:.1f} s", t - start_t_);
  if (end_t_) line += fmt::format(" of {:.1f} s", *end_t_ - start_t_);
  line += fmt::format(", {:.1f} times real time", factor);
  if (end_t_ && factor > 0.0) line += fmt::format(", {:.0f} s left", (*end_t_ - t) / factor);
  line_.show(line);
}

CountProgress::CountProgress(bool quiet, std::size_t total, std::string what)
    : line_(quiet), total_(total), what_(std::move(what)) {}

void CountProgress::show(std::size_t done) {
  if (!line_.is_due()) return;
  std::string line = fmt::format("{} of {} {}", done, total_, what_);
  if (done > 0) {
    const double each = line_.elapsed() / static_cast<double>(done);
    line += fmt::format(", {:.0f} s left", each * static_cast<double>(total_ - done));
  }
  line_.show(line);
}

}  // namespace harness
