#include "harness/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace harness {

namespace {

constexpr std::chrono::milliseconds pause{250};
constexpr const char* clear_line = "\r\033[K";

}  // namespace

Progress::Progress(bool quiet, double start_t, std::optional<double> end_t)
    : is_shown_(!quiet && isatty(STDERR_FILENO) == 1), start_t_(start_t), end_t_(end_t) {}

Progress::~Progress() {
  if (is_shown_) fmt::print(stderr, "{}", clear_line);
}

void Progress::show(double t) {
  if (!is_shown_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < pause) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const double factor = (t - start_t_) / elapsed;
  std::string line = fmt::format("{:.1f} s", t - start_t_);
  if (end_t_) line += fmt::format(" of {:.1f} s", *end_t_ - start_t_);
  line += fmt::format(", {:.1f} times real time", factor);
  if (end_t_ && factor > 0.0) line += fmt::format(", {:.0f} s left", (*end_t_ - t) / factor);
  fmt::print(stderr, "{}{}", clear_line, line);
  std::fflush(stderr);
}

}  // namespace harness
