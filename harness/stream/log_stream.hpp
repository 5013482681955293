// A recorded log as a stream. It gives the same events, bit for bit, as the recorded run. See
// docs/log_format.md.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/files/csv_reader.hpp"
#include "harness/stream/recorded_log.hpp"
#include "harness/stream/truth_track.hpp"

namespace harness {

/// Gives the truth of a log at any time; calls must come in the order of time. It is a TruthTrack of
/// truth.csv.
class TruthReader {
 public:
  /// Reads the truth of the log in this folder. The longest gap comes from its log.yaml.
  explicit TruthReader(const std::filesystem::path& folder);

  TruthReader(const std::filesystem::path& file, double longest_gap);

  bool has_wheel_angles() const { return rows_.has_optional(); }

  /// The truth at time `t` [s]; empty if it is not known. Throws BadInput.
  std::optional<TruePose> at(double t);

 private:
  std::optional<TruePose> next_row();

  CsvReader rows_;
  std::optional<double> last_t_;  // [s]
  TruthTrack track_;
};

/// Reads a log folder in bounded memory. All functions throw BadInput: `file:line:column: reason`.
class LogStream final : public RecordedLog {
 public:
  explicit LogStream(const std::filesystem::path& folder);

  const LogDescription& description() const override { return description_; }

  bool next(Event& event) override;

  ReadCounts counts() const override { return counts_; }

 private:
  bool scan_is_due() const;
  void read_odometry_row();
  void read_observation_row();
  seif::Observation observation() const;
  void fill(ScanEvent& event);
  void add_observation(ScanEvent& event);
  std::optional<TruePose> truth_at(double t);

  LogDescription description_;
  CsvReader odometry_rows_;
  CsvReader observation_rows_;
  std::optional<CsvReader> true_id_rows_;
  std::optional<TruthReader> truth_;
  bool odometry_left_ = true;
  bool observation_left_ = true;
  seif::Odometry odometry_;     // from the last row that was read
  double observation_t_ = 0.0;  // [s] from the last row that was read
  std::optional<TruePose> last_truth_;
  ScanMemory memory_;
  ReadCounts counts_;
};

/// Reads landmarks.csv, sorted by id. Throws BadInput.
std::vector<TrueLandmark> read_landmarks(const std::filesystem::path& file);

}  // namespace harness
