#include "seif/first_estimate_frame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace seif {
namespace {

/// The pose after the rigid motion that brings the means closest to the first estimates, in the least-squares
/// sense. Nothing for fewer than two landmarks.
std::optional<Pose2> fitted(std::span<const FirstEstimate> landmarks, const Pose2& pose) {
  if (landmarks.size() < 2) return std::nullopt;
  Eigen::Vector2d mean_centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d first_centre = Eigen::Vector2d::Zero();
  for (const FirstEstimate& landmark : landmarks) {
    mean_centre += landmark.mean;
    first_centre += landmark.first;
  }
  mean_centre /= static_cast<double>(landmarks.size());
  first_centre /= static_cast<double>(landmarks.size());
  double cosine = 0.0;  // of the angle of the turn; both times the same factor
  double sine = 0.0;
  for (const FirstEstimate& landmark : landmarks) {
    const Eigen::Vector2d a = landmark.mean - mean_centre;
    const Eigen::Vector2d b = landmark.first - first_centre;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const double angle = cosine == 0.0 && sine == 0.0 ? 0.0 : std::atan2(sine, cosine);
  const Eigen::Vector2d p =
      first_centre + Eigen::Rotation2Dd(angle) * (Eigen::Vector2d(pose.x, pose.y) - mean_centre);
  return Pose2{p.x(), p.y(), wrap_angle(pose.theta + angle)};
}

}  // namespace

FramedPose pose_among(std::span<FirstEstimate> landmarks, const Pose2& pose, const Pose2& carried,
                      double sighting_sd) {
  const Eigen::Vector2d here(pose.x, pose.y);
  const auto fit_to = [&](const Pose2& at) {
    return [&here, sighting_sd, there = Eigen::Vector2d(at.x, at.y)](const FirstEstimate& landmark) {
      return are_levers_alike(landmark.first - there, landmark.mean - here, sighting_sd);
    };
  };
  const auto others = std::ranges::partition(landmarks, fit_to(carried));
  const std::span<const FirstEstimate> near = landmarks.first(landmarks.size() - others.size());
  const Pose2 kept = fitted(near, pose).value_or(carried);
  const auto fitting = static_cast<std::size_t>(std::ranges::count_if(landmarks, fit_to(kept)));
  if (2 * fitting >= landmarks.size()) return {.pose = kept};

  const std::optional<Pose2> moved = fitted(others, pose);
  if (!moved) return {.pose = kept};
  const auto fitting_moved = static_cast<std::size_t>(std::ranges::count_if(landmarks, fit_to(*moved)));
  if (fitting_moved <= fitting) return {.pose = kept};
  return {.pose = *moved, .another_frame = true};
}

}  // namespace seif
