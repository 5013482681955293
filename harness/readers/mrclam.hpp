// A folder of the UTIAS Multi-Robot Cooperative Localization and Mapping Dataset, seen by one of its robots.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>

#include "harness/files/row_reader.hpp"
#include "harness/readers/log_noise.hpp"
#include "harness/readers/velocity_log.hpp"

namespace harness {

/// Barcodes, landmarks and truth come from the folder. The start is the true pose if it is known, otherwise
/// the origin. All functions throw BadInput.
class MrclamLog final : public VelocityLog {
 public:
  MrclamLog(const std::filesystem::path& folder, int robot);

  static bool is_in(const std::filesystem::path& folder);

  /// Chosen on dataset 6 with all five robots: docs/datasets.md. The noise is larger than the errors of
  /// single measurements, because errors at one place are much alike.
  static LogNoise default_noise();

 protected:
  std::optional<VelocityRow> read_velocity() override;
  std::optional<ObservationRow> read_observation() override;
  std::optional<TruePose> read_truth() override;

 private:
  std::map<std::int64_t, seif::LandmarkId> subjects_;  // by barcode
  RowReader velocity_rows_;
  RowReader observation_rows_;
  std::optional<RowReader> truth_rows_;
  std::optional<double> velocity_t_;     // [s] of the last row
  std::optional<double> observation_t_;  // [s]
  std::optional<double> truth_t_;        // [s]
};

}  // namespace harness
