// A world that is moved step by step, by commands from outside.
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "harness/run/runnable_world.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "python/bindings.hpp"
#include "python/long_call.hpp"
#include "python/problems.hpp"

namespace seifbed {

namespace {

/// What was measured at one time, and the truth then.
struct Measurements {
  double t = 0.0;                          // [s]
  std::optional<seif::Odometry> odometry;  // the motion since the last reading
  std::optional<seif::Scan> scan;          // if the sensor looked at this time
  sim::RobotState robot;                   // the truth
};

class Environment {
 public:
  Environment(const std::filesystem::path& world, const std::vector<std::string>& overrides)
      : world_(sound_world(harness::load_runnable_world(world, overrides, known_registry()))) {
    reset(std::nullopt);
  }

  void reset(std::optional<std::uint64_t> seed) {
    const std::unique_lock lock = hold();
    if (seed) world_.seed = *seed;
    stream_ = std::make_unique<harness::SimulatedStream>(world_, harness::SteeringPose{});
  }

  /// Moves by the command until something is measured. Nothing: the world's duration is over.
  std::optional<Measurements> step(double v, double omega) {
    const std::unique_lock lock = hold();
    stream_->move_by({.v = v, .omega = omega});
    harness::Event event;
    if (!stream_->next(event)) return std::nullopt;
    Measurements measured;
    take(event, measured);
    while (stream_->is_due() && stream_->next(event)) take(event, measured);
    measured.robot = stream_->robot();
    return measured;
  }

  /// What `look(stream, world)` returns, while no other thread moves the robot.
  template <class Look>
  auto look(const Look& look) const {
    const std::unique_lock lock = hold();
    return look(*stream_, world_);
  }

 private:
  std::unique_lock<std::mutex> hold() const {
    std::unique_lock lock(in_use_, std::try_to_lock);
    if (!lock) throw std::runtime_error("another thread is using this environment");
    return lock;
  }

  static void take(const harness::Event& event, Measurements& measured) {
    if (const auto* odometry = std::get_if<harness::OdometryEvent>(&event)) {
      measured.t = odometry->odometry.t;
      measured.odometry = odometry->odometry;
    } else {
      measured.t = std::get<harness::ScanEvent>(event).scan.t;
      measured.scan = std::get<harness::ScanEvent>(event).scan;
    }
  }

  worlds::World world_;
  std::unique_ptr<harness::SimulatedStream> stream_;
  mutable std::mutex in_use_;
};

py::dict truth_of(const sim::RobotState& robot) {
  using namespace py::literals;
  return py::dict("t"_a = robot.t,
                  "pose"_a = array_of({robot.position.x(), robot.position.y(), robot.heading}),
                  "v"_a = robot.v, "omega"_a = robot.omega, "left_wheel"_a = robot.left_wheel,
                  "right_wheel"_a = robot.right_wheel);
}

/// (measurements, truth), or None if the world's duration is over.
py::object step(Environment& environment, double v, double omega) {
  std::optional<Measurements> measured;
  {
    const WithoutGil released;
    measured = environment.step(v, omega);
  }
  if (!measured) return py::none();
  const py::dict truth = truth_of(measured->robot);
  return py::make_tuple(std::move(*measured), truth);
}

py::dict description_of(const harness::SimulatedStream& stream, const worlds::World& world) {
  using namespace py::literals;
  const harness::LogDescription& log = stream.description();
  const std::vector<worlds::Landmark>& landmarks = world.landmarks;
  py::array_t<double> positions(std::vector<py::ssize_t>{std::ssize(landmarks), 2});
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    positions.mutable_data()[2 * i] = landmarks[i].position.x();
    positions.mutable_data()[2 * i + 1] = landmarks[i].position.y();
  }
  return py::dict("name"_a = log.name, "seed"_a = world.seed, "start"_a = array_of(log.start.mean),
                  "start_covariance"_a = log.start.covariance, "sensor"_a = array_of(log.T_robot_sensor),
                  "landmarks"_a = positions);
}

}  // namespace

void bind_environment(py::module_& module) {
  using namespace py::literals;
  py::class_<Measurements>(module, "Measurements", "What was measured at one time.")
      .def_readonly("t", &Measurements::t, "Time [s].")
      .def_readonly("odometry", &Measurements::odometry, "Odometry, or None.")
      .def_readonly("scan", &Measurements::scan, "Scan, or None if the sensor did not look at this time.");
  py::class_<Environment>(module, "Environment", "A world that is moved step by step.")
      .def(py::init<const std::filesystem::path&, const std::vector<std::string>&>(), "world"_a,
           "overrides"_a)
      .def("reset", &Environment::reset, "seed"_a = py::none())
      .def("step", &step, "v"_a, "omega"_a)
      .def(
          "truth",
          [](const Environment& environment) {
            return truth_of(environment.look([](const auto& stream, const auto&) { return stream.robot(); }));
          })
      .def("description", [](const Environment& environment) { return environment.look(&description_of); })
      .def_property_readonly("physics_steps", [](const Environment& environment) {
        return environment.look([](const auto& stream, const auto&) { return stream.physics_steps(); });
      });
}

}  // namespace seifbed
