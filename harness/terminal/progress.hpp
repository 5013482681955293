// Progress of one run or of many, on a terminal.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace harness {

/// A line on stderr that is rewritten from time to time, if stderr is a terminal.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();  // clears the line
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// True if it is time to show something new.
  bool is_due();
  void show(const std::string& line);
  double elapsed() const;  // [s] since construction

 private:
  using Clock = std::chrono::steady_clock;

  bool is_shown_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
};

/// The progress of one run.
class Progress {
 public:
  /// `end_t` [s]: the end of the run; empty: not known.
  Progress(bool quiet, double start_t, std::optional<double> end_t);

  void show(double t);

 private:
  StatusLine line_;
  double start_t_;
  std::optional<double> end_t_;
};

/// The progress of many tasks of about equal duration.
class CountProgress {
 public:
  /// `what`: the name of the tasks in the plural.
  CountProgress(bool quiet, std::size_t total, std::string what);

  void show(std::size_t done);

 private:
  StatusLine line_;
  std::size_t total_;  // [-]
  std::string what_;
};

}  // namespace harness
