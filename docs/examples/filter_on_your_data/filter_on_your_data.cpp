// The filter `seif` on data of your own: two scans with a motion between them.
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <numbers>
#include <vector>

#include "seif/make_estimator.hpp"

int main() {
  const Eigen::Matrix3d start_noise = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();        // [m, rad] squared
  const Eigen::Matrix3d motion_noise = Eigen::Vector3d(1e-4, 1e-6, 1e-5).asDiagonal();       // [m, rad] squared
  const Eigen::Matrix2d sighting_noise = Eigen::Vector2d(0.05 * 0.05, 1e-4).asDiagonal();    // [m, rad] squared

  const seif::EstimatorSetup setup{.start = {{0, 0, 0}, start_noise}, .T_robot_sensor = {0.1, 0, 0}, .random = {}};
  const std::unique_ptr<seif::Estimator> filter =
      seif::make_estimator(seif::standard_estimators(), "seif", setup, {{"theta_x", std::int64_t{8}}});

  const auto stage_done = [](seif::Stage) {};
  filter->measurement_update({0.0, {{7, 2.0, 0.5, sighting_noise}, {3, 3.0, -0.5, sighting_noise}}}, stage_done);
  filter->motion_update({0.2, {0.5, 0.0, 0.1}, motion_noise});
  filter->measurement_update({0.2, {{7, 1.65, 0.5, sighting_noise}, {3, 2.55, -0.7, sighting_noise}}}, stage_done);

  const seif::Pose2 pose = filter->pose();
  std::cout << "pose: " << pose.x << " m, " << pose.y << " m, " << 180 / std::numbers::pi * pose.theta << " deg\n";
  const std::vector<seif::LandmarkId> both = {7, 3};  // in the order in which they joined the map
  const auto covariances = filter->marginal_covariances(both);
  for (std::size_t i = 0; const seif::LandmarkEstimate& landmark : filter->map()) {
    std::cout << "landmark " << landmark.landmark << ": " << landmark.mean.transpose() << " m, covariance [m^2]\n"
              << covariances->landmarks[i++] << '\n';
  }
}
