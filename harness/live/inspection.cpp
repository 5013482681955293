#include "harness/live/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "harness/files/bad_input.hpp"
#include "harness/live/message.hpp"
#include "harness/score/score.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_links_told = 24;   // [-] the strongest
constexpr std::size_t most_inspected = 5000;  // [-] landmarks; the covariances of a larger map take too long
constexpr auto not_known = std::numeric_limits<float>::quiet_NaN();

/// The largest correlation between a coordinate of one landmark and one of the other. [-]
double correlation(const Eigen::MatrixXd& P, Eigen::Index a, Eigen::Index b) {
  double largest = 0.0;
  for (Eigen::Index i = a; i < a + 2; ++i) {
    for (Eigen::Index j = b; j < b + 2; ++j) {
      const double value = P(i, j) / std::sqrt(P(i, i) * P(j, j));
      if (std::abs(value) > std::abs(largest)) largest = value;
    }
  }
  return largest;
}

std::vector<seif::Coupling> strongest_links(const seif::Estimator& filter, seif::LandmarkId landmark) {
  std::vector<seif::Coupling> links;
  filter.couplings(landmark, links);
  std::ranges::sort(links, std::ranges::greater{}, &seif::Coupling::strength);
  if (links.size() > most_links_told) links.resize(most_links_told);
  return links;
}

/// Covariance, NEES, and correlations with the landmarks that it is linked to.
void add_covariances(Json& json, const seif::Estimator& filter, const seif::LandmarkIds& group,
                     const std::optional<Eigen::Vector2d>& error) {
  const auto joint = filter.joint_covariances(std::span(&group, 1));
  if (!joint) return;
  const Eigen::MatrixXd& P = joint->front();
  const Eigen::Matrix2d own = P.block<2, 2>(3, 3);
  json["covariance"] = {own(0, 0), own(0, 1), own(1, 1)};
  if (error) {
    if (const std::optional<double> value = nees(*error, own)) json["nees"] = *value;
  }
  for (std::size_t i = 1; i < group.size(); ++i)
    json["correlations"].push_back({group[i], correlation(P, 3, 3 + 2 * static_cast<Eigen::Index>(i))});
}

}  // namespace

void SightingLog::add(const ScanEvent& event) {
  Sighting sighting;
  sighting.t = static_cast<float>(event.scan.t);
  sighting.x = sighting.y = sighting.theta = not_known;
  if (event.truth) {
    sighting.x = static_cast<float>(event.truth->T_world_robot.x);
    sighting.y = static_cast<float>(event.truth->T_world_robot.y);
    sighting.theta = static_cast<float>(event.truth->T_world_robot.theta);
  }
  for (const seif::Observation& z : event.scan.observations) {
    if (z.landmark == seif::no_landmark) continue;
    sighting.range = static_cast<float>(z.range);
    sighting.bearing = static_cast<float>(z.bearing);
    Ring& ring = rings_[z.landmark];
    ring.sightings[static_cast<std::size_t>(ring.count++) % kept] = sighting;
  }
}

std::vector<SightingLog::Sighting> SightingLog::of(seif::LandmarkId landmark) const {
  std::vector<Sighting> latest;
  const auto ring = rings_.find(landmark);
  if (ring == rings_.end()) return latest;
  const std::int64_t count = ring->second.count;
  for (std::int64_t i = std::max<std::int64_t>(0, count - static_cast<std::int64_t>(kept)); i < count; ++i)
    latest.push_back(ring->second.sightings[static_cast<std::size_t>(i) % kept]);
  return latest;
}

std::int64_t SightingLog::count(seif::LandmarkId landmark) const {
  const auto ring = rings_.find(landmark);
  return ring == rings_.end() ? 0 : ring->second.count;
}

PageMessage landmark_message(const LiveEstimator& estimator, seif::LandmarkId landmark,
                             const std::optional<Eigen::Vector2d>& truth, const SightingLog& sightings) {
  const seif::Estimator& filter = *estimator.filter;
  std::vector<seif::LandmarkEstimate> found;
  filter.landmarks(std::array{landmark}, found);
  if (found.empty())
    throw BadInput(fmt::format("landmark {} is not in the map of {}", landmark, estimator.name));
  const Eigen::Vector2d mean = found.front().mean;
  const std::vector<seif::Coupling> links = strongest_links(filter, landmark);
  Json json = {
      {"kind", "landmark"}, {"estimator", estimator.name}, {"id", landmark}, {"mean", {mean.x(), mean.y()}}};
  json["truth"] = truth ? Json({truth->x(), truth->y()}) : Json(nullptr);
  json["covariance"] = json["nees"] = nullptr;
  json["links"] = json["correlations"] = json["observations"] = Json::array();
  seif::LandmarkIds group = {landmark};
  for (const seif::Coupling& link : links) {
    json["links"].push_back({link.other == seif::no_landmark ? -1 : link.other, link.strength});
    if (link.other != seif::no_landmark) group.push_back(link.other);
  }
  if (filter.map().size() <= most_inspected) {
    const std::optional<Eigen::Vector2d> error =
        truth ? std::optional<Eigen::Vector2d>(mean - *truth) : std::nullopt;
    add_covariances(json, filter, group, error);
  }
  for (const SightingLog::Sighting& z : sightings.of(landmark))
    json["observations"].push_back(
        {{"t", z.t}, {"range_m", z.range}, {"bearing_rad", z.bearing}, {"robot", {z.x, z.y, z.theta}}});
  json["seen"] = sightings.count(landmark);
  PageMessage message;
  write_message(json.dump(-1, ' ', false, Json::error_handler_t::replace), {}, message);
  return message;
}

}  // namespace harness
