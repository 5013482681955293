#include "harness/film/stage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "harness/film/paint.hpp"
#include "worlds/geometry.hpp"

namespace harness {

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double unknown_reach = 8.0;  // [m] if the log does not give the sensor's range
constexpr double post_height = 0.7;    // [m]

render::Solid upright_box(const worlds::Rectangle& rectangle, double height, Rgb colour) {
  render::Solid solid;
  const double heading = std::atan2(rectangle.axis.y(), rectangle.axis.x());
  solid.T_world_solid = Translation3d(rectangle.centre.x(), rectangle.centre.y(), 0.5 * height) *
                        AngleAxisd(heading, Vector3d::UnitZ());
  solid.size = {2.0 * rectangle.half.x(), 2.0 * rectangle.half.y(), height};
  solid.colour = paint(colour);
  return solid;
}

void extend(std::optional<Area>& area, const Vector2d& p) {
  if (!area) area = Area{p, p};
  area->min = area->min.cwiseMin(p);
  area->max = area->max.cwiseMax(p);
}

/// What appears in a world during a run, the latest first.
std::vector<worlds::Fault> things_to_come(const worlds::World& world) {
  std::vector<worlds::Fault> things;
  for (const worlds::Fault& fault : world.faults) {
    if (fault.kind == worlds::FaultKind::ice || fault.kind == worlds::FaultKind::wall ||
        fault.kind == worlds::FaultKind::landmark)
      things.push_back(fault);
  }
  std::ranges::stable_sort(things, std::ranges::greater{}, &worlds::Fault::at);
  return things;
}

/// A part of the robot, given in the robot's frame.
render::Solid part(const Isometry3d& T_world_robot, const Isometry3d& T_robot_part, render::Shape shape,
                   const Vector3d& size, Rgb colour) {
  return {shape, T_world_robot * T_robot_part, size, paint(colour)};
}

}  // namespace

Stage::Stage(const worlds::World& world, bool knows_world, const LogDescription& log,
             const std::optional<Area>& path)
    : robot_(world.robot),
      ground_size_(world.ground_size),
      reach_(knows_world ? world.landmark_sensor.max_range : unknown_reach) {
  if (log.landmarks) landmarks_ = &*log.landmarks;
  std::optional<Area> subject;
  extend(subject, {log.start.mean.x, log.start.mean.y});
  for (std::size_t i = 0; landmarks_ != nullptr && i < landmarks_->size(); ++i) {
    posts_.put((*landmarks_)[i].landmark, (*landmarks_)[i].position);
    extend(subject, (*landmarks_)[i].position);
  }
  if (landmarks_ != nullptr) landmarks_shown_ = landmarks_->size();
  if (knows_world) {
    add_solids(world);
    to_come_ = things_to_come(world);
    for (const worlds::Fault& fault : to_come_) {
      if (fault.kind == worlds::FaultKind::landmark && landmarks_shown_ > 0) --landmarks_shown_;
    }
    for (const worlds::Wall& wall : world.walls) {
      for (const Vector2d& corner : wall.points) extend(subject, corner);
    }
    for (const Vector2d& corner : world.drive.path) extend(subject, corner);
  }
  const Vector2d margin = Vector2d::Constant(0.5);
  subject_ = {subject->min - margin, subject->max + margin};
  if (path) {  // what lies out of reach of the path is not seen
    const Vector2d reach = Vector2d::Constant(reach_);
    subject_.min = subject_.min.cwiseMax(path->min - reach).cwiseMin(path->min - margin);
    subject_.max = subject_.max.cwiseMin(path->max + reach).cwiseMax(path->max + margin);
  }
  if ((subject_.max - subject_.min).maxCoeff() < reach_) {  // too small an area for an overview
    const Vector2d middle = 0.5 * (subject_.min + subject_.max);
    subject_ = {middle - Vector2d::Constant(reach_), middle + Vector2d::Constant(reach_)};
  }
  if (!knows_world)
    ground_size_ =
        2.0 * (subject_.min.cwiseAbs().cwiseMax(subject_.max.cwiseAbs()) + Vector2d::Constant(reach_));
}

void Stage::add_solids(const worlds::World& world) {
  for (const worlds::FrictionPatch& patch : world.physics.patches) add_patch(patch);
  for (const worlds::Box& box : world.boxes)
    solids_.push_back(upright_box(worlds::rectangle(box), box.height, paints::box));
  for (const worlds::Wall& wall : world.walls) add_wall(wall);
}

void Stage::add_patch(const worlds::FrictionPatch& patch) {
  constexpr double thickness = 0.005;  // [m] visible, but too thin for a shadow
  const Vector2d middle = 0.5 * (patch.min + patch.max);
  solids_.push_back(
      upright_box({middle, Vector2d::UnitX(), 0.5 * (patch.max - patch.min)}, thickness, paints::ice));
}

void Stage::add_wall(const worlds::Wall& wall) {
  for (const worlds::Segment& leg : worlds::legs(wall.points, wall.closed)) {
    worlds::Rectangle rectangle = worlds::rectangle(leg, wall.thickness);
    rectangle.half.x() += 0.5 * wall.thickness;  // so that legs meet at their corners
    solids_.push_back(upright_box(rectangle, wall.height, paints::wall));
  }
}

void Stage::let_appear(double t) {
  for (; !to_come_.empty() && to_come_.back().at <= t; to_come_.pop_back()) {
    const worlds::Fault& fault = to_come_.back();
    if (fault.kind == worlds::FaultKind::ice) add_patch(fault.patch);
    if (fault.kind == worlds::FaultKind::wall) add_wall(fault.wall);
    if (fault.kind == worlds::FaultKind::landmark) ++landmarks_shown_;
  }
}

render::Ground Stage::ground(bool with_grid) const {
  render::Ground ground;
  ground.size = ground_size_;
  if (!with_grid) ground.grid = 0.0;
  return ground;
}

double Stage::radius(seif::LandmarkId id) const {
  const auto it = std::ranges::lower_bound(*landmarks_, id, {}, &TrueLandmark::landmark);
  return it->radius;
}

void Stage::append_surroundings(const Frustum& frustum, const Area& area, render::Things& things) {
  for (const render::Solid& solid : solids_) {
    if (frustum.sees(solid.T_world_solid.translation(), solid.size.norm())) things.solids.push_back(solid);
  }
  if (landmarks_ == nullptr) return;
  posts_.within(area, in_area_);
  for (const seif::LandmarkId id : in_area_) {
    if (!to_come_.empty() && static_cast<std::size_t>(id) >= landmarks_shown_) continue;
    const Vector2d position = *posts_.position(id);
    if (!frustum.sees({position.x(), position.y(), 0.0}, 2.0 * post_height)) continue;
    render::Post post;
    post.position = position;
    post.radius = static_cast<float>(std::max(radius(id), 0.03));
    post.height = static_cast<float>(post_height);
    post.colour = paint(paints::post);
    things.posts.push_back(post);
  }
}

double Stage::robot_length() const {
  const worlds::Footprint footprint = worlds::footprint(robot_);
  return footprint.max.x() - footprint.min.x();
}

void Stage::append_robot(const TruePose& pose, double size, render::Things& things) const {
  const double r = robot_.wheel_radius;
  const double width = worlds::wheel_width(robot_);
  const worlds::Footprint footprint = worlds::footprint(robot_);
  const Isometry3d T_world_robot = Translation3d(pose.T_world_robot.x, pose.T_world_robot.y, 0.0) *
                                   AngleAxisd(pose.T_world_robot.theta, Vector3d::UnitZ());
  const auto add = [&](Isometry3d T_robot_part, render::Shape shape, const Vector3d& extent, Rgb colour) {
    T_robot_part.translation() *= size;
    things.solids.push_back(part(T_world_robot, T_robot_part, shape, size * extent, colour));
  };
  // The hull is narrower than the track, so that the wheels are visible.
  const double length = footprint.max.x() - footprint.min.x();
  const double middle = 0.5 * (footprint.max.x() + footprint.min.x());
  const double hull = robot_.track - 1.3 * width;
  add(Isometry3d(Translation3d(middle, 0.0, 1.15 * r)), render::Shape::box, {length, hull, 1.3 * r},
      paints::shell);
  add(Isometry3d(Translation3d(middle, 0.0, 1.85 * r)), render::Shape::box,
      {0.92 * length, 0.92 * hull, 0.1 * r}, palette::orange);
  add(Isometry3d(Translation3d(robot_.caster.offset, 0.0, robot_.caster.radius)), render::Shape::cylinder,
      Vector3d::Constant(2.0 * robot_.caster.radius), paints::tyre);
  // A disc on top, near the front, shows which way the robot faces.
  add(Isometry3d(Translation3d(footprint.max.x() - 0.35 * r, 0.0, 2.1 * r)), render::Shape::cylinder,
      {0.7 * r, 0.7 * r, 0.5 * r}, paints::tyre);
  for (const double side : {1.0, -1.0}) {
    const double angle = side > 0.0 ? pose.left_wheel : pose.right_wheel;
    const Isometry3d T_robot_wheel =
        Translation3d(0.0, side * 0.5 * robot_.track, r) * AngleAxisd(angle, Vector3d::UnitY());
    const Isometry3d T_robot_disk = T_robot_wheel * AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX());
    add(T_robot_disk, render::Shape::cylinder, {2.0 * r, 2.0 * r, width}, paints::tyre);
    add(T_robot_wheel, render::Shape::box, {1.5 * r, 1.1 * width, 0.28 * r}, palette::odometry);
    add(T_robot_wheel, render::Shape::box, {0.28 * r, 1.1 * width, 1.5 * r}, palette::odometry);
  }
}

}  // namespace harness
