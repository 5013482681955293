// The log of the Freiburg course "Robot Mapping": sensor_data.dat, and world.dat beside it if it exists.
#pragma once

#include <filesystem>

#include "harness/files/row_reader.hpp"
#include "harness/readers/log_noise.hpp"
#include "harness/stream/recorded_log.hpp"

namespace harness {

/// The log has no times, so a step counts as a second. The robot starts at the origin of world.dat. All
/// functions throw BadInput.
class FreiburgLog final : public RecordedLog {
 public:
  explicit FreiburgLog(const std::filesystem::path& sensor_data);

  /// See docs/datasets.md.
  static LogNoise default_noise();

  const LogDescription& description() const override { return description_; }
  bool next(Event& event) override;
  ReadCounts counts() const override { return counts_; }

 private:
  bool read_row();
  void fill(ScanEvent& event);
  void add_observation(ScanEvent& event);

  LogDescription description_;
  ReadCounts counts_;
  RowReader rows_;
  bool row_left_ = false;  // the current row of rows_ has not been used yet
  double t_ = 0.0;         // [s]
  ScanMemory memory_;
};

}  // namespace harness
