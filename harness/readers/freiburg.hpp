// The log of the Freiburg course "Robot Mapping": sensor_data.dat, and world.dat beside it where it is known.
#pragma once

#include <filesystem>

#include "harness/files/row_reader.hpp"
#include "harness/readers/log_noise.hpp"
#include "harness/stream/recorded_log.hpp"

namespace harness {

/// A step is a second: the log has no times. It begins at the origin of world.dat. All functions throw
/// BadInput.
class FreiburgLog final : public RecordedLog {
 public:
  explicit FreiburgLog(const std::filesystem::path& sensor_data);

  /// docs/datasets.md.
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
  bool row_left_ = false;  // rows_ stands on a row that no event has been made of
  double t_ = 0.0;         // [s]
  ScanMemory memory_;
};

}  // namespace harness
