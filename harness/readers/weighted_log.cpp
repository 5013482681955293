#include "harness/readers/weighted_log.hpp"

#include <utility>
#include <variant>

namespace harness {

WeightedLog::WeightedLog(std::unique_ptr<RecordedLog> log, const LogNoise& noise)
    : log_(std::move(log)), noise_(noise), description_(log_->description()) {
  if (noise_.sensor) description_.noise = *noise_.sensor;
}

bool WeightedLog::next(Event& event) {
  if (!log_->next(event)) return false;
  if (auto* odometry = std::get_if<OdometryEvent>(&event); odometry != nullptr && noise_.odometry) {
    odometry->odometry.covariance = covariance(*noise_.odometry, odometry->odometry.T_previous_current);
  }
  if (auto* scan = std::get_if<ScanEvent>(&event); scan != nullptr && noise_.sensor) {
    for (seif::Observation& observation : scan->scan.observations)
      observation.covariance = covariance(*noise_.sensor, observation.range);
  }
  return true;
}

}  // namespace harness
