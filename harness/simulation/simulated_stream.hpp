// A simulated world as a stream. It advances physics, drive and sensors from one measurement to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "harness/simulation/drive.hpp"
#include "harness/simulation/fault_injection.hpp"
#include "harness/stream/log_description.hpp"
#include "harness/stream/stream.hpp"
#include "sensors/landmark_sensor.hpp"
#include "sensors/wheel_encoders.hpp"
#include "sim/simulator.hpp"
#include "worlds/world.hpp"

namespace harness {

/// Gives the pose T_world_robot that steers, up to date with all that next() has returned. Empty: the truth
/// steers.
using SteeringPose = std::function<seif::Pose2()>;

/// What the estimators of a world are told before its first event. The true start and the true landmarks are
/// not part of it.
LogDescription description_without_truth(const worlds::World& world);

/// Each source of randomness has its own random stream: "encoders", "encoder_systematic", "landmark_sensor",
/// "start_estimate", "drive".
class SimulatedStream final : public Stream {
 public:
  /// Throws std::invalid_argument if a rate is below 1 Hz or above the physics' step rate.
  SimulatedStream(const worlds::World& world, SteeringPose steering_pose);
  /// Uses an existing simulator of this world.
  SimulatedStream(const worlds::World& world, SteeringPose steering_pose,
                  std::unique_ptr<sim::Simulator> simulator);
  SimulatedStream(const SimulatedStream&) = delete;
  SimulatedStream& operator=(const SimulatedStream&) = delete;

  const LogDescription& description() const { return description_; }

  /// The robot is steered at each odometry reading, by the pose that is believed after that reading.
  bool next(Event& event) override;

  enum class Advance { event, step, end };
  /// Gives the next event if one is due; otherwise moves the world by one physics step, or says that the run is over.
  Advance advance(Event& event);

  double step_s() const { return 1.0 / world_.physics.step_rate; }  // of the physics
  /// The earliest time of an intervention: the end of the next physics step. [s]
  double next_step_t() const { return static_cast<double>(step_ + 1) / world_.physics.step_rate; }

  // Interventions. Each takes effect at the physics step that begins at its time, and gives the bits that a world
  // file with it gives. All throw std::invalid_argument if their time is before next_step_t().

  /// A fault of any kind but `option`. Throws std::invalid_argument if it cannot happen in this world, or if the robot
  /// stands where something is to appear at the next step. Where the world has landmarks that appear later, theirs are
  /// the ids after the new one's.
  void inject(const worlds::Fault& fault);
  /// A sensor that is silent without an end speaks again.
  void end_silence(worlds::FaultySensor sensor, double t);
  /// Somebody takes the wheel or gives it back. The row takes the place of one of the same time.
  void take_over(const worlds::Takeover& row);
  /// The run ends so much later. [s]
  void extend(double duration);

  /// From now on this command moves the robot, and not the drive.
  void move_by(const sim::Command& command);

  /// Whether another event is due at the time of the last one, so that next() moves nothing.
  bool is_due() const { return odometry_clock_.next_step() <= step_ || scan_clock_.next_step() <= step_; }

  sim::RobotState robot() const { return simulator_->robot(); }  // the truth
  std::int64_t physics_steps() const { return step_; }           // [-] since the start

 private:
  /// A periodic event, counted in whole physics steps: times are not accumulated.
  struct Clock {
    std::int64_t rate = 1;       // [Hz]
    std::int64_t step_rate = 1;  // [Hz]
    std::int64_t ticks = 1;      // [-] number of the next event; the first is one period after the start
    std::int64_t next_step() const { return ticks * step_rate / rate; }
  };

  double t() const;  // [s]
  void check_time(double t) const;
  void let_appear(const worlds::Fault& fault);
  void intervene();
  TruePose truth() const;
  void steer();
  void read_encoders(OdometryEvent& event);
  void scan(ScanEvent& event);
  bool way_is_clear(const Eigen::Vector2d& p_robot_goal, double clearance) const;
  void check_room(const worlds::Fault& fault) const;
  LogDescription describe() const;
  std::vector<TrueLandmark> true_landmarks() const;

  worlds::World world_;
  std::unique_ptr<sim::Simulator> simulator_;
  SteeringPose steering_pose_;
  sensors::WheelEncoders encoders_;
  sensors::LandmarkSensor landmark_sensor_;
  Drive drive_;
  FaultInjection faults_;
  sensors::LineOfSight line_of_sight_;
  std::int64_t step_ = 0;
  LogDescription description_;

  std::int64_t last_step_;
  Clock odometry_clock_;
  Clock scan_clock_;
  bool must_steer_ = true;
  sim::Command command_;
  std::optional<sim::Command> given_command_;       // instead of the drive's
  std::size_t next_takeover_ = 0;                   // row of the world's
  std::vector<int> in_range_;                       // reused from scan to scan
  std::vector<sensors::LandmarkTruth> candidates_;  // reused from scan to scan
  ScanMemory memory_;
};

}  // namespace harness
