// The progress of one run or many, on a terminal.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace harness {

/// A line of stderr that is rewritten from time to time, if stderr is a terminal.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();  // clears the line
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Whether it is time for an update of the line.
  bool is_due();
  void show(const std::string& line);
  double elapsed() const;  // [s] since it was made

 private:
  using Clock = std::chrono::steady_clock;

  bool is_shown_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
};

/// The progress of one run.
class Progress {
 public:
  /// `end_t` [s]: where the run ends, if that is known.
  Progress(bool quiet, double start_t, std::optional<double> end_t);

  void show(double t);

 private:
  StatusLine line_;
  double start_t_;
  std::optional<double> end_t_;
};

/// The progress of many tasks that take about the same time each.
class CountProgress {
 public:
  /// `what`: their name in the plural.
  CountProgress(bool quiet, std::size_t total, std::string what);

  void show(std::size_t done);

 private:
  StatusLine line_;
  std::size_t total_;  // [-]
  std::string what_;
};

}  // namespace harness
