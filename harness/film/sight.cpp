#include "harness/film/sight.hpp"

#include <algorithm>
#include <cmath>

#include "harness/film/paint.hpp"

namespace harness {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

}  // namespace

Sight::Sight(const worlds::World& world, bool knows_world, const seif::Pose2& T_robot_sensor)
    : sensor_(world.landmark_sensor), T_robot_sensor_(T_robot_sensor) {
  if (!knows_world) return;
  landmarks_ = world.landmarks;
  simulator_ = sim::make_simulator(world);
}

/// A ray ends at the true landmark if that is known, otherwise at the measured position.
void Sight::scan(const ScanEvent& event, const seif::Pose2& T_world_robot, const Stage& stage) {
  const seif::Pose2 T_world_sensor = T_world_robot * T_robot_sensor_;
  rays_.clear();
  seen_.clear();
  for (std::size_t i = 0; i < event.scan.observations.size(); ++i) {
    const seif::Observation& z = event.scan.observations[i];
    const seif::LandmarkId id = event.true_ids.empty() ? z.landmark : event.true_ids[i];
    const Vector2d measured =
        T_world_sensor * Vector2d(z.range * std::cos(z.bearing), z.range * std::sin(z.bearing));
    rays_.push_back({stage.true_position(id).value_or(measured),
                     id == seif::no_landmark ? Kind::false_detection : Kind::seen});
    seen_.push_back(id);
  }
  if (simulator_) find_hidden(T_world_sensor);
}

/// Finds the landmarks that are in range and in the field of view, but behind something.
void Sight::find_hidden(const seif::Pose2& T_world_sensor) {
  const Vector2d p_world_sensor(T_world_sensor.x, T_world_sensor.y);
  const seif::Pose2 T_sensor_world = inverse(T_world_sensor);
  simulator_->landmarks_within(p_world_sensor, sensor_.max_range, in_range_);
  for (const int id : in_range_) {
    if (std::ranges::find(seen_, id) != seen_.end()) continue;
    const Vector2d& p_world = landmarks_[static_cast<std::size_t>(id)].position;
    const Vector2d p_sensor = T_sensor_world * p_world;
    const bool is_in_field = std::abs(std::atan2(p_sensor.y(), p_sensor.x())) <= 0.5 * sensor_.fov;
    if (is_in_field && !simulator_->line_of_sight(p_world_sensor, id))
      rays_.push_back({p_world, Kind::hidden});
  }
}

void Sight::append_rays(const seif::Pose2& T_world_robot, double height, float scale,
                        render::Things& things) const {
  const seif::Pose2 T_world_sensor = T_world_robot * T_robot_sensor_;
  const Vector3d from(T_world_sensor.x, T_world_sensor.y, height);
  for (const Ray& ray : rays_) {
    const Vector3d end(ray.end.x(), ray.end.y(), height);
    const render::Colour colour = ray.kind == Kind::seen     ? paint(palette::sky_blue, 0.85F)
                                  : ray.kind == Kind::hidden ? paint(paints::hidden_ray, 0.6F)
                                                             : paint(palette::purple, 0.6F);
    things.marks.strokes.push_back({from, end, 1.5F * scale, colour});
    if (ray.kind == Kind::false_detection)
      things.marks.dots.push_back({end, 3.0F * scale, paint(palette::purple)});
  }
}

void Sight::append_range(const seif::Pose2& T_world_robot, float scale, render::Things& things) const {
  if (!simulator_) return;  // the range is not known from a log
  const seif::Pose2 T_world_sensor = T_world_robot * T_robot_sensor_;
  render::Ellipse sector;
  sector.centre = {T_world_sensor.x, T_world_sensor.y, 0.01};
  sector.axes = sensor_.max_range * Eigen::Rotation2Dd(T_world_sensor.theta).toRotationMatrix();
  sector.half_angle = 0.5 * sensor_.fov;
  sector.outline_width = 1.0F * scale;
  sector.outline = paint(palette::sky_blue, 0.55F);
  sector.fill = paint(palette::sky_blue, 0.10F);
  things.marks.ellipses.push_back(sector);
}

}  // namespace harness
