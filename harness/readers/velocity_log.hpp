// Logs with velocities and observations at different times: the common part of their readers.
#pragma once

#include <optional>

#include "harness/stream/recorded_log.hpp"
#include "harness/stream/truth_track.hpp"

namespace harness {

/// The velocity from a time on, until the next row.
struct VelocityRow {
  double t = 0.0;      // [s]
  double v = 0.0;      // [m/s] forward
  double omega = 0.0;  // [rad/s] counter-clockwise
};

struct ObservationRow {
  double t = 0.0;  // [s]
  seif::Observation observation;
};

/// Merges the rows of two or three files into one stream. Between two velocity rows the robot drives an arc;
/// a scan in between cuts the arc in two. Observations with the same time are one scan.
class VelocityLog : public RecordedLog {
 public:
  const LogDescription& description() const final { return description_; }
  bool next(Event& event) final;
  ReadCounts counts() const final { return counts_; }

 protected:
  /// The next row of each kind, in the order of time; empty at the end.
  virtual std::optional<VelocityRow> read_velocity() = 0;
  virtual std::optional<ObservationRow> read_observation() = 0;
  virtual std::optional<TruePose> read_truth() { return std::nullopt; }

  /// Reads the first rows and enters the time and truth of the start into description_. A constructor must
  /// call it once, after the rest of the description is complete.
  void begin();

  /// The time since the first velocity, without the rounding error that the difference of two large numbers
  /// leaves. [s]
  double since_start(double t) const;

  LogDescription description_;
  ReadCounts counts_;

 private:
  void advance_velocity();
  void leave_out_what_nothing_leads_to();
  void fill(ScanEvent& event);
  std::optional<TruePose> truth_at(double t);

  double zero_ = 0.0;  // [s] time of the first velocity in the log
  double t_ = 0.0;     // [s] of the last event
  VelocityRow now_;
  std::optional<VelocityRow> next_velocity_;
  std::optional<ObservationRow> next_observation_;
  TruthTrack truth_;
  ScanMemory memory_;
};

}  // namespace harness
