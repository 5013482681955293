// How far a run is, on a terminal.
#pragma once

#include <chrono>
#include <optional>

namespace harness {

/// Rewrites one line of stderr now and then, if that is a terminal.
class Progress {
 public:
  /// `end_t` [s]: where the run ends, if that is known.
  Progress(bool quiet, double start_t, std::optional<double> end_t);
  ~Progress();  // clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double t);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_shown_;
  double start_t_;
  std::optional<double> end_t_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
};

}  // namespace harness
