#include "harness/doctor/self_test.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "sim/render/renderer.hpp"
#include "sim/simulator.hpp"
#include "worlds/load.hpp"

namespace harness {

namespace {

void require(bool holds, const std::string& otherwise) {
  if (!holds) throw std::runtime_error(otherwise);
}

/// The state of the robot after four seconds of this command.
sim::RobotState driven(const worlds::World& world, const sim::Command& command) {
  const std::unique_ptr<sim::Simulator> simulator = sim::make_simulator(world);
  for (int i = 0; i < 4 * world.physics.step_rate; ++i) simulator->step(command);
  return simulator->robot();
}

/// Without slip, the robot in Bullet arrives where kinematics says, except for a little creep of the wheels.
std::string physics() {
  constexpr sim::Command command{0.5, 0.2};
  worlds::World world;
  const sim::RobotState robot = driven(world, command);
  require(robot.position == driven(world, command).position, "the same drive twice, and other bits");
  world.physics.engine = worlds::Engine::kinematic;
  const double apart = (robot.position - driven(world, command).position).norm();
  const std::string text = fmt::format("2 m driven, {:.1f} mm from where kinematics leads", 1e3 * apart);
  require(apart < 0.05, text);
  return text;
}

/// One landmark in the open, and one behind a wall.
worlds::World walled_world() {
  worlds::World world;
  world.duration = 40.0;
  world.landmarks = {{{4.0, 0.0}, 0.1}, {{-4.0, 0.0}, 0.1}};
  world.walls = {{.points = {{-2.0, -2.0}, {-2.0, 2.0}}}};
  return world;
}

std::string sensing() {
  const worlds::World world = walled_world();
  SimulatedStream stream(world, {});
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (Event event; stream.next(event);) {
    const auto* scan = std::get_if<ScanEvent>(&event);
    if (scan == nullptr) continue;
    for (const seif::Observation& observation : scan->scan.observations) {
      require(observation.landmark == 0, "a landmark was seen through a wall");
      const double error = observation.range - 4.0;
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  require(count == 200, fmt::format("{} of 200 scans saw the landmark", count));
  const double sd = world.landmark_sensor.range_sd;
  const double measured = std::sqrt(squares / count);
  const std::string text =
      fmt::format("200 scans, ranges off by {:.1f} mm in the mean, sd {:.1f} mm of {:.1f}", 1e3 * sum / count,
                  1e3 * measured, 1e3 * sd);
  // Both within four of their own standard deviations. The robot's resting place varies by micrometres only.
  require(std::abs(sum / count) < 4.0 * sd / std::sqrt(count), text);
  require(std::abs(measured / sd - 1.0) < 4.0 / std::sqrt(2.0 * count), text);
  return text;
}

constexpr const char* loop_world =
    "name: doctor\n"
    "duration_s: 60\n"
    "landmarks: {generators: [{type: uniform, count: 40, region: {min_m: [-8, -8], max_m: [8, 8]}}]}\n"
    "drive: {mode: loop, waypoints_m: [[4, 0], [4, 4], [-4, 4], [-4, -4], [4, -4]]}\n"
    "estimators: {ekf: {}, seif: {}}\n";

worlds::World load_loop(const std::filesystem::path& folder, const seif::Registry& registry) {
  write_whole_file(folder / "world.yaml", loop_world);
  const worlds::LoadResult loaded =
      worlds::load_world(folder / "world.yaml", {}, estimator_schemas(registry));
  require(loaded.world.has_value(),
          loaded.problems.empty() ? "no world" : worlds::to_string(loaded.problems.front()));
  return *loaded.world;
}

RunResult executed(PreparedRun run, const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  run.plan.folder = folder;
  run.plan.quiet = true;
  RunResult result = execute(run);
  require(result.error.empty(), result.error);
  for (const std::string& failure : result.summary.failures) require(failure.empty(), failure);
  return result;
}

/// Drives round a square, and checks the map, the belief, and that a replay gives the same bits.
std::string estimation(const seif::Registry& registry) {
  const TemporaryFolder folder;
  const worlds::World world = load_loop(folder.path(), registry);
  const Summary live = executed(prepare_run(world, registry), folder / "live").summary;
  std::string text;
  for (const EstimatorScore& score : live.score.estimators) {
    const double error = score.landmarks.rmse_aligned.value_or(NAN);
    const double nees = score.nees_pose.value_or(NAN);
    text += fmt::format("{}: {:.0f} mm, NEES {:.2f}; ", score.name, 1e3 * error, nees);
    require(error < 0.1 && nees < 10.0, text + "that is no map");
  }
  require(!live.score.estimators.empty(), "there was nothing to score");
  const Summary again = executed(prepare_replay(folder / "live", world, registry), folder / "again").summary;
  require(again.trajectory_hash == live.trajectory_hash, "a replay of the record gave other bits");
  return text + "its replay gave the same bits";
}

/// A red box on grey ground, seen from above.
render::Scene boxed_scene(int width, int height) {
  render::Scene scene;
  scene.things.solids.resize(1);
  scene.things.solids[0].size = {4.0, 4.0, 1.0};
  scene.things.solids[0].colour = {0.9F, 0.1F, 0.1F, 1.0F};
  render::View view;
  view.width = width;
  view.height = height;
  view.camera.eye = {0.0, 0.0, 20.0};
  view.camera.up = Eigen::Vector3d::UnitY();
  view.camera.height = 12.0;
  scene.views = {view};
  return scene;
}

std::string rendering() {
  constexpr int width = 320;
  constexpr int height = 240;
  const auto is_red = [](const std::uint8_t* pixel) {
    return pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2];
  };
  render::Renderer renderer(width, height);
  const render::Scene scene = boxed_scene(width, height);
  render::Image first;
  render::Image second;
  renderer.draw(scene, first);
  const auto begin = std::chrono::steady_clock::now();
  renderer.draw(scene, second);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  require(is_red(first.pixel(width / 2, height / 2)), "a red box does not show");
  require(!is_red(first.pixel(2, 2)), "all is red where there is one box");
  require(first.rgb == second.rgb, "the same scene twice, and other pixels");
  return fmt::format("a picture of {} x {} in {:.1f} ms", width, height, took.count());
}

}  // namespace

std::vector<Finding> test_self(const seif::Registry& registry) {
  return {finding("physics", physics), finding("sensing", sensing),
          finding("estimation", [&] { return estimation(registry); }), finding("rendering", rendering)};
}

}  // namespace harness
