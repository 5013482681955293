#include "seif/relocating/local_map.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/relocating/placement.hpp"

namespace seif {
namespace {

constexpr double start_sd = 1e-3;  // [m, rad]; moves the map as a whole, which nobody sees

}  // namespace

void LocalMap::begin() {
  EstimatorSetup setup;
  setup.start.covariance = start_sd * start_sd * Eigen::Matrix3d::Identity();
  setup.T_robot_sensor = T_robot_sensor_;
  filter_ = make_filter_(setup);
  scans_ = 0;
}

void LocalMap::measurement_update(const Scan& scan) {
  filter_->measurement_update(scan, [](Stage) {});
  if (!scan.observations.empty()) ++scans_;
}

Surroundings LocalMap::read(double t, std::size_t most) {
  LocalBelief& belief = *filter_->local_belief();
  belief.begin_association(t);
  std::vector<LandmarkId> ids;
  belief.landmarks_at_hand(ids);
  const Pose2 T_world_robot = filter_->pose();
  const Eigen::Vector2d here(T_world_robot.x, T_world_robot.y);
  std::ranges::sort(ids, [&](LandmarkId a, LandmarkId b) {
    const double to_a = (belief.mean_of(a) - here).squaredNorm();
    const double to_b = (belief.mean_of(b) - here).squaredNorm();
    return to_a != to_b ? to_a < to_b : a < b;
  });
  if (ids.size() > most) ids.resize(most);
  return surroundings_of(belief, T_world_robot, std::move(ids));
}

}  // namespace seif
