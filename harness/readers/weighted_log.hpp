// A log whose measurements get their covariances from a noise model.
#pragma once

#include <memory>

#include "harness/readers/log_noise.hpp"
#include "harness/stream/recorded_log.hpp"

namespace harness {

class WeightedLog final : public RecordedLog {
 public:
  /// A part that `noise` leaves empty keeps the recorded covariances.
  WeightedLog(std::unique_ptr<RecordedLog> log, const LogNoise& noise);

  const LogDescription& description() const override { return description_; }
  bool next(Event& event) override;
  ReadCounts counts() const override { return log_->counts(); }

 private:
  std::unique_ptr<RecordedLog> log_;
  LogNoise noise_;
  LogDescription description_;
};

}  // namespace harness
