#include "harness/score/seen_landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "harness/score/true_names.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {

namespace {

constexpr double lone_radius = 0.5;   // [m] in a world with one landmark
constexpr double floor_radius = 0.2;  // [m]
constexpr double sigmas = 3.7;        // [-] 99.9 % of the observations of a landmark are nearer

}  // namespace

SeenLandmarks::SeenLandmarks(const LogDescription& log) : log_(log) {}

SeenScan SeenLandmarks::of(const ScanEvent& event) {
  SeenScan seen{event.scan.t, {}};
  for (std::size_t i = 0; i < event.scan.observations.size(); ++i) {
    std::optional<seif::LandmarkId> id = true_id(event, i);
    if (!id && event.truth && log_.landmarks)
      id = by_place(event.scan.observations[i], event.truth->T_world_robot);
    if (!id) continue;
    is_known_ = true;
    if (*id != seif::no_landmark) seen.landmarks.push_back(*id);
  }
  return seen;
}

seif::LandmarkId SeenLandmarks::by_place(const seif::Observation& observation,
                                         const seif::Pose2& T_world_robot) {
  if (!places_) {
    std::vector<Eigen::Vector2d> points;
    for (const TrueLandmark& landmark : *log_.landmarks) points.push_back(landmark.position);
    places_.emplace(std::move(points));
    const std::optional<double> spacing = places_->spacing();
    radius_ = spacing ? 0.5 * *spacing : lone_radius;
  }
  const Eigen::Vector2d p_sensor =
      observation.range * Eigen::Vector2d(std::cos(observation.bearing), std::sin(observation.bearing));
  const Eigen::Vector2d p = T_world_robot * (log_.T_robot_sensor * p_sensor);
  const double across = observation.range * observation.range * observation.covariance(1, 1);
  const double sd = std::sqrt(std::max(observation.covariance(0, 0), across));
  const auto found = places_->nearest(p, std::min(radius_, floor_radius + sigmas * sd));
  return found ? (*log_.landmarks)[*found].landmark : seif::no_landmark;
}

std::optional<std::set<seif::LandmarkId>> read_seen_landmarks(const std::filesystem::path& folder) {
  LogStream stream(folder);
  SeenLandmarks seen(stream.description());
  std::set<seif::LandmarkId> all;
  for (Event event; stream.next(event);) {
    if (const auto* scan = std::get_if<ScanEvent>(&event)) {
      const SeenScan now = seen.of(*scan);
      all.insert(now.landmarks.begin(), now.landmarks.end());
    }
  }
  return seen.is_known() ? std::optional(std::move(all)) : std::nullopt;
}

}  // namespace harness
