#include "harness/simulation/simulated_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sensors/random_stream.hpp"
#include "worlds/check_faults.hpp"
#include "worlds/geometry.hpp"

namespace harness {

namespace {

seif::Pose2 pose_of(const worlds::Placement& placement) {
  return {placement.position.x(), placement.position.y(), placement.heading};
}

sensors::WheelEncoders make_encoders(const worlds::World& world) {
  const worlds::Encoders& encoders = world.encoders;
  std::mt19937_64 random = sensors::random_stream(world.seed, "encoder_systematic");
  std::normal_distribution<double> normal;
  const double diameter_error = encoders.diameter_ratio_sd * normal(random);
  const double track_error = encoders.track_ratio_sd * normal(random);
  sensors::WheelEncoderOptions options;
  options.wheel_radius = world.robot.wheel_radius;
  options.track = world.robot.track;
  options.ticks_per_revolution = encoders.ticks_per_revolution;
  options.distance_sd = encoders.distance_sd;
  options.diameter_ratio = encoders.calibrated ? 1.0 : encoders.diameter_ratio + diameter_error;
  options.track_ratio = encoders.calibrated ? 1.0 : encoders.track_ratio + track_error;
  return {options, sensors::random_stream(world.seed, "encoders")};
}

sensors::LandmarkSensor make_landmark_sensor(const worlds::World& world) {
  const worlds::LandmarkSensor& sensor = world.landmark_sensor;
  sensors::LandmarkSensorOptions options;
  options.T_robot_sensor = pose_of(sensor.mount);
  options.max_range = sensor.max_range;
  options.fov = sensor.fov;
  options.range_sd = sensor.range_sd;
  options.range_sd_per_m = sensor.range_sd_per_m;
  options.bearing_sd = sensor.bearing_sd;
  options.miss_probability = sensor.miss_probability;
  options.false_detections = sensor.false_detections;
  options.misread_probability = sensor.misread_probability;
  options.hides_ids = sensor.ids == worlds::LandmarkIds::hidden;
  options.first_false_id = static_cast<seif::LandmarkId>(world.landmarks.size());
  return {options, sensors::random_stream(world.seed, "landmark_sensor")};
}

/// Drawn from N(truth, P0), so that the filters' initial belief is correct.
seif::PoseEstimate draw_start(const worlds::World& world) {
  std::mt19937_64 random = sensors::random_stream(world.seed, "start_estimate");
  std::normal_distribution<double> normal;
  const worlds::StartEstimate& sd = world.start_estimate;
  seif::PoseEstimate start;
  start.mean = pose_of(world.robot.start);
  start.mean.x += sd.x_sd * normal(random);
  start.mean.y += sd.y_sd * normal(random);
  start.mean.theta = seif::wrap_angle(start.mean.theta + sd.heading_sd * normal(random));
  start.covariance =
      Eigen::Vector3d(sd.x_sd * sd.x_sd, sd.y_sd * sd.y_sd, sd.heading_sd * sd.heading_sd).asDiagonal();
  return start;
}

std::int64_t checked_rate(const char* what, int rate, int step_rate) {
  if (rate >= 1 && rate <= step_rate) return rate;
  throw std::invalid_argument(
      fmt::format("the {} rate of {} Hz is not from 1 Hz to the physics' {} Hz", what, rate, step_rate));
}

const char* name_of(worlds::FaultKind kind) {
  if (kind == worlds::FaultKind::ice) return "ice";
  return kind == worlds::FaultKind::wall ? "wall" : "landmark";
}

/// How far the thing that appears is from a point. [m]
double distance_to(const worlds::Fault& fault, const Eigen::Vector2d& p) {
  if (fault.kind == worlds::FaultKind::landmark)
    return (fault.landmark.position - p).norm() - fault.landmark.radius;
  double least = std::numeric_limits<double>::infinity();
  for (const worlds::Segment& leg : worlds::legs(fault.wall.points, fault.wall.closed)) {
    worlds::Rectangle solid = worlds::rectangle(leg, fault.wall.thickness);
    solid.half.x() += 0.5 * fault.wall.thickness;  // corners are filled
    least = std::min(least, worlds::distance(p, solid));
  }
  return least;
}

/// A log stores one triangle of a covariance. Live estimators must get the same matrix as in a replay.
template <class Matrix>
void make_symmetric(Matrix& covariance) {
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) covariance(i, j) = covariance(j, i);
  }
}

}  // namespace

LogDescription description_without_truth(const worlds::World& world) {
  const worlds::LandmarkSensor& sensor = world.landmark_sensor;
  LogDescription log;
  log.name = world.name;
  log.T_robot_sensor = pose_of(sensor.mount);
  log.noise = {sensor.range_sd, sensor.range_sd_per_m, sensor.bearing_sd};
  log.max_range = sensor.max_range;
  log.start = draw_start(world);
  log.known_association = sensor.ids == worlds::LandmarkIds::known;
  return log;
}

SimulatedStream::SimulatedStream(const worlds::World& world, SteeringPose steering_pose)
    : SimulatedStream(world, std::move(steering_pose), sim::make_simulator(world)) {}

SimulatedStream::SimulatedStream(const worlds::World& world, SteeringPose steering_pose,
                                 std::unique_ptr<sim::Simulator> simulator)
    : world_(world),
      simulator_(std::move(simulator)),
      steering_pose_(std::move(steering_pose)),
      encoders_(make_encoders(world)),
      landmark_sensor_(make_landmark_sensor(world)),
      drive_(world.drive, world.robot, sensors::random_stream(world.seed, "drive"),
             [this](const Eigen::Vector2d& p_robot_goal, double clearance) {
               return way_is_clear(p_robot_goal, clearance);
             }),
      faults_(world.faults),
      line_of_sight_([this](const Eigen::Vector2d& p_world_sensor, seif::LandmarkId landmark) {
        return simulator_->line_of_sight(p_world_sensor, landmark);
      }),
      description_(describe()),
      last_step_(std::llround(world.duration * world.physics.step_rate)),
      odometry_clock_{checked_rate("odometry", world.encoders.rate, world.physics.step_rate),
                      world.physics.step_rate},
      scan_clock_{checked_rate("scan", world.landmark_sensor.rate, world.physics.step_rate),
                  world.physics.step_rate} {}

LogDescription SimulatedStream::describe() const {
  const worlds::LandmarkSensor& sensor = world_.landmark_sensor;
  LogDescription log = description_without_truth(world_);
  log.has_truth = true;
  log.has_wheel_angles = true;
  log.has_true_ids =
      !log.known_association || sensor.false_detections > 0.0 || sensor.misread_probability > 0.0;
  log.true_start = truth();
  log.landmarks = true_landmarks();
  return log;
}

/// Those that are there, then those to come. The simulator numbers them in this order too.
std::vector<TrueLandmark> SimulatedStream::true_landmarks() const {
  std::vector<TrueLandmark> landmarks;
  const auto add = [&](const worlds::Landmark& landmark) {
    landmarks.push_back(
        {static_cast<seif::LandmarkId>(landmarks.size()), landmark.position, landmark.radius});
  };
  std::ranges::for_each(world_.landmarks, add);
  std::ranges::for_each(faults_.landmarks_to_come(), add);
  return landmarks;
}

double SimulatedStream::t() const { return static_cast<double>(step_) / world_.physics.step_rate; }

TruePose SimulatedStream::truth() const {
  const sim::RobotState robot = simulator_->robot();
  return {t(), {robot.position.x(), robot.position.y(), robot.heading}, robot.left_wheel, robot.right_wheel};
}

bool SimulatedStream::way_is_clear(const Eigen::Vector2d& p_robot_goal, double clearance) const {
  const seif::Pose2 T_world_robot = truth().T_world_robot;
  const Eigen::Vector2d p_world_goal = T_world_robot * p_robot_goal;
  const Eigen::Vector2d free = 0.5 * world_.ground_size - Eigen::Vector2d::Constant(clearance);
  if ((p_world_goal.cwiseAbs().array() > free.array()).any()) return false;
  return simulator_->path_is_clear({T_world_robot.x, T_world_robot.y}, p_world_goal, clearance);
}

void SimulatedStream::steer() {
  if (!must_steer_) return;
  must_steer_ = false;
  command_ = given_command_ ? *given_command_
                            : drive_.command(t(), steering_pose_ ? steering_pose_() : truth().T_world_robot);
}

void SimulatedStream::move_by(const sim::Command& command) {
  if (!std::isfinite(command.v) || !std::isfinite(command.omega))
    throw std::invalid_argument(fmt::format("the command ({}, {}) is not finite", command.v, command.omega));
  given_command_ = command;
  must_steer_ = true;
}

bool SimulatedStream::next(Event& event) {
  Advance done = Advance::step;
  while (done == Advance::step) done = advance(event);
  return done == Advance::event;
}

SimulatedStream::Advance SimulatedStream::advance(Event& event) {
  // Both may be due at the same step. Odometry comes first.
  if (odometry_clock_.next_step() <= step_) {
    must_steer_ = true;
    ++odometry_clock_.ticks;
    if (faults_.is_silent(worlds::FaultySensor::encoders, t())) return advance(event);
    read_encoders(memory_.odometry(event));
    return Advance::event;
  }
  if (scan_clock_.next_step() <= step_) {
    ++scan_clock_.ticks;
    if (faults_.is_silent(worlds::FaultySensor::landmark_sensor, t())) return advance(event);
    scan(memory_.scan(event));
    return Advance::event;
  }
  if (step_ >= last_step_) return Advance::end;
  intervene();
  steer();
  simulator_->step(command_);
  ++step_;
  return Advance::step;
}

/// What happens to the world at this step, and who steers from it on.
void SimulatedStream::intervene() {
  while (const worlds::Fault* fault = faults_.thing(t())) let_appear(*fault);
  if (const auto place = faults_.kidnapping(t())) simulator_->place(*place);
  const std::vector<worlds::Takeover>& rows = world_.drive.takeover;
  for (; next_takeover_ < rows.size() && rows[next_takeover_].t <= t() + time_rounding; ++next_takeover_) {
    const worlds::Takeover& row = rows[next_takeover_];
    given_command_.reset();
    if (!row.released) given_command_ = sim::Command{row.v, row.omega};
    must_steer_ = true;
  }
}

void SimulatedStream::let_appear(const worlds::Fault& fault) {
  try {
    if (fault.kind == worlds::FaultKind::ice) return simulator_->add_patch(fault.patch);
    if (fault.kind == worlds::FaultKind::wall) {
      simulator_->add_wall(fault.wall);
      return world_.walls.push_back(fault.wall);
    }
    simulator_->add_landmark(fault.landmark);
    world_.landmarks.push_back(fault.landmark);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("at {} s: the {} of the world's faults cannot appear: {}", t(),
                                         name_of(fault.kind), error.what()));
  }
}

void SimulatedStream::check_time(double t) const {
  if (!(t >= next_step_t() - time_rounding))
    throw std::invalid_argument(
        fmt::format("an intervention at {} s comes too late: the earliest is {} s", t, next_step_t()));
}

/// The simulator looks again when the thing appears. By then the robot has moved by one step, so more room is asked for.
void SimulatedStream::check_room(const worlds::Fault& fault) const {
  const bool comes_next = fault.at < next_step_t() + 0.5 * step_s();
  const double spare = std::max(0.05, 2.0 * world_.robot.max_speed * step_s());  // [m]
  const double distance = distance_to(fault, simulator_->robot().position);
  if (comes_next && !(distance >= worlds::footprint_radius(world_.robot) + spare))
    throw std::invalid_argument("there is no room: the robot stands there");
}

void SimulatedStream::inject(const worlds::Fault& fault) {
  using worlds::FaultKind;
  check_time(fault.at);
  if (fault.kind == FaultKind::option) throw std::invalid_argument("the world has no options of estimators");
  std::string why = worlds::why_it_cannot_appear(fault, world_);
  if (fault.kind == FaultKind::kidnapping) why = worlds::why_it_has_no_room(fault.to, world_);
  if (!why.empty()) throw std::invalid_argument(why);
  if (fault.kind == FaultKind::landmark || fault.kind == FaultKind::wall) check_room(fault);
  faults_.add(fault);
  if (fault.kind == FaultKind::landmark) description_.landmarks = true_landmarks();
}

void SimulatedStream::end_silence(worlds::FaultySensor sensor, double t) {
  check_time(t);
  faults_.end_silence(sensor, t);
}

void SimulatedStream::take_over(const worlds::Takeover& row) {
  check_time(row.t);
  std::vector<worlds::Takeover>& rows = world_.drive.takeover;
  const auto to_come = rows.begin() + static_cast<std::ptrdiff_t>(next_takeover_);
  const auto place =
      std::lower_bound(to_come, rows.end(), row.t, [](const auto& r, double t) { return r.t < t; });
  if (place != rows.end() && place->t == row.t) {
    *place = row;
  } else {
    rows.insert(place, row);
  }
}

void SimulatedStream::extend(double duration) {
  last_step_ += std::llround(duration * world_.physics.step_rate);
}

void SimulatedStream::read_encoders(OdometryEvent& event) {
  event.truth = truth();
  const WheelJumps jumps = faults_.encoder_jumps(t());
  event.odometry = encoders_.read(event.truth->t, event.truth->left_wheel + jumps.left,
                                  event.truth->right_wheel + jumps.right);
  make_symmetric(event.odometry.covariance);
}

void SimulatedStream::scan(ScanEvent& event) {
  event.truth = truth();
  const seif::Pose2 T_world_sensor = event.truth->T_world_robot * description_.T_robot_sensor;
  simulator_->landmarks_within({T_world_sensor.x, T_world_sensor.y}, world_.landmark_sensor.max_range,
                               in_range_);
  candidates_.clear();
  for (const int index : in_range_)
    candidates_.push_back({index, world_.landmarks[static_cast<std::size_t>(index)].position});
  landmark_sensor_.scan(event.truth->t, event.truth->T_world_robot, candidates_, line_of_sight_, event.scan,
                        event.true_ids);
  for (seif::Observation& observation : event.scan.observations) make_symmetric(observation.covariance);
  faults_.spoil(event.scan);
}

}  // namespace harness
