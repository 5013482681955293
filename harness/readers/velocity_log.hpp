// Logs of velocities and observations at different times; shared by their readers.
#pragma once

#include <optional>

#include "harness/stream/recorded_log.hpp"
#include "harness/stream/truth_track.hpp"

namespace harness {

/// The robot's motion from a time on, until the next row.
struct VelocityRow {
  double t = 0.0;      // [s]
  double v = 0.0;      // [m/s] ahead
  double omega = 0.0;  // [rad/s] counter-clockwise
};

struct ObservationRow {
  double t = 0.0;  // [s]
  seif::Observation observation;
};

/// Puts the rows of two or three files into one stream. Between two rows of velocities the robot drives an
/// arc; where a scan comes in between, the arc is cut there. Observations of the same time are one scan.
class VelocityLog : public RecordedLog {
 public:
  const LogDescription& description() const final { return description_; }
  bool next(Event& event) final;
  ReadCounts counts() const final { return counts_; }

 protected:
  /// The next row of each kind, in the order of time; nothing at the end.
  virtual std::optional<VelocityRow> read_velocity() = 0;
  virtual std::optional<ObservationRow> read_observation() = 0;
  virtual std::optional<TruePose> read_truth() { return std::nullopt; }

  /// Reads the first rows; the time and the truth of the start are then in description_. To be called once by
  /// a constructor, when all else of the description stands.
  void begin();

  /// A time relative to the first velocity, rounded so that subtracting two large numbers leaves no noise in the
  /// last digits. [s]
  double since_start(double t) const;

  LogDescription description_;
  ReadCounts counts_;

 private:
  void advance_velocity();
  void leave_out_what_nothing_leads_to();
  void fill(ScanEvent& event);
  std::optional<TruePose> truth_at(double t);

  double zero_ = 0.0;  // [s] the time of the first velocity in the log
  double t_ = 0.0;     // [s] of the last event
  VelocityRow now_;
  std::optional<VelocityRow> next_velocity_;
  std::optional<ObservationRow> next_observation_;
  TruthTrack truth_;
  ScanMemory memory_;
};

}  // namespace harness
