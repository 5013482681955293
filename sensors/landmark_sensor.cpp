#include "sensors/landmark_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sensors {

namespace {

void check(const LandmarkSensorOptions& options) {
  if (!(options.max_range > 0.0 && options.fov > 0.0 && options.fov <= 2.0 * std::numbers::pi)) {
    throw std::invalid_argument("landmark sensor: range must be positive, field of view in (0, 2 pi]");
  }
  if (!(options.range_sd > 0.0 && options.bearing_sd > 0.0 && options.range_sd_per_m >= 0.0)) {
    throw std::invalid_argument("landmark sensor: standard deviations must be positive");
  }
  if (!(options.miss_probability >= 0.0 && options.miss_probability <= 1.0)) {
    throw std::invalid_argument("landmark sensor: the miss probability must be in [0, 1]");
  }
  if (!(options.misread_probability >= 0.0 && options.misread_probability <= 1.0)) {
    throw std::invalid_argument("landmark sensor: the misread probability must be in [0, 1]");
  }
  if (!(options.false_detections >= 0.0 && std::isfinite(options.false_detections))) {
    throw std::invalid_argument(
        "landmark sensor: the mean number of false detections must be finite, not negative");
  }
}

}  // namespace

LandmarkSensor::LandmarkSensor(const LandmarkSensorOptions& options, std::mt19937_64 random)
    : options_(options), random_(random), next_false_id_(options.first_false_id) {
  check(options);
}

void LandmarkSensor::scan(double t, const seif::Pose2& T_world_robot,
                          std::span<const LandmarkTruth> candidates, const LineOfSight& line_of_sight,
                          seif::Scan& scan, std::vector<seif::LandmarkId>& true_ids) {
  scan.t = t;
  scan.observations.clear();
  true_ids.clear();
  misreadings_.clear();
  const seif::Pose2 T_world_sensor = T_world_robot * options_.T_robot_sensor;
  const seif::Pose2 T_sensor_world = inverse(T_world_sensor);
  const Eigen::Vector2d p_world_sensor(T_world_sensor.x, T_world_sensor.y);
  for (const LandmarkTruth& truth : candidates) {
    const Eigen::Vector2d p_sensor = T_sensor_world * truth.p_world;
    const double range = p_sensor.norm();
    const double bearing = std::atan2(p_sensor.y(), p_sensor.x());
    if (range <= options_.max_range && std::abs(bearing) <= 0.5 * options_.fov &&
        line_of_sight(p_world_sensor, truth.landmark)) {
      detect(truth, range, bearing, scan, true_ids);
    }
  }
  misread_ids(scan);
  detect_falsely(scan, true_ids);
  if (!options_.hides_ids) return;
  for (seif::Observation& observation : scan.observations) observation.landmark = seif::no_landmark;
}

/// Measures a visible landmark. A missed landmark draws its noise, too: then the random numbers of the next
/// landmark depend only on which landmarks are visible.
void LandmarkSensor::detect(const LandmarkTruth& truth, double range, double bearing, seif::Scan& scan,
                            std::vector<seif::LandmarkId>& true_ids) {
  const bool missed = uniform_(random_) < options_.miss_probability;
  const double range_error = std::sqrt(range_variance(range)) * standard_normal_(random_);
  const double bearing_error = options_.bearing_sd * standard_normal_(random_);
  const bool may_misread = options_.misread_probability > 0.0 && options_.first_false_id > 0;
  const bool misread = may_misread && uniform_(random_) < options_.misread_probability;
  const double which = may_misread ? uniform_(random_) : 0.0;
  if (missed) {
    return;
  }
  // A negative range is reflected. Drawing again would make the number of draws depend on their values.
  // Clamping would put many ranges at exactly zero, where the bearing has no meaning.
  scan.observations.push_back(
      observation(truth.landmark, std::abs(range + range_error), seif::wrap_angle(bearing + bearing_error)));
  true_ids.push_back(truth.landmark);
  if (misread)
    misreadings_.push_back(
        {scan.observations.size() - 1,
         static_cast<seif::LandmarkId>(which * static_cast<double>(options_.first_false_id))});
}

/// Each misread observation gets the first id, counted from the drawn one, that no other observation of the
/// scan has, so that all ids stay different. If all ids are used, it keeps its own.
void LandmarkSensor::misread_ids(seif::Scan& scan) const {
  const auto is_borne = [&](seif::LandmarkId id) {
    return std::ranges::find(scan.observations, id, &seif::Observation::landmark) != scan.observations.end();
  };
  for (const Misreading& misreading : misreadings_) {
    seif::LandmarkId id = misreading.drawn;
    for (std::size_t tries = 0; is_borne(id) && tries < scan.observations.size(); ++tries)
      id = (id + 1) % options_.first_false_id;
    if (!is_borne(id)) scan.observations[misreading.observation].landmark = id;
  }
}

/// The number is Poisson distributed; the positions are uniform over the area of the field of view, so the
/// density of ranges grows with the range.
void LandmarkSensor::detect_falsely(seif::Scan& scan, std::vector<seif::LandmarkId>& true_ids) {
  if (options_.false_detections == 0.0) {
    return;  // the distribution needs a positive mean
  }
  const int count = std::poisson_distribution<int>(options_.false_detections)(random_);
  for (int i = 0; i < count; ++i) {
    const double range = options_.max_range * std::sqrt(uniform_(random_));
    const double bearing = options_.fov * (uniform_(random_) - 0.5);
    scan.observations.push_back(observation(next_false_id_++, range, seif::wrap_angle(bearing)));
    true_ids.push_back(seif::no_landmark);
  }
}

/// The covariance is the one that a sensor can know: it uses the measured range, not the true one.
seif::Observation LandmarkSensor::observation(seif::LandmarkId landmark, double range, double bearing) const {
  seif::Observation z;
  z.landmark = landmark;
  z.range = range;
  z.bearing = bearing;
  z.covariance.diagonal() << range_variance(range), options_.bearing_sd * options_.bearing_sd;
  return z;
}

double LandmarkSensor::range_variance(double range) const {
  const double growing_sd = options_.range_sd_per_m * range;
  return options_.range_sd * options_.range_sd + growing_sd * growing_sd;
}

}  // namespace sensors
