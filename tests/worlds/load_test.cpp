#include "worlds/load.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "world_files.hpp"
#include "worlds/limits.hpp"

namespace worlds {
namespace {

using test::fake_estimators;
using test::Folder;
using test::load_text;
using test::text_of;

/// The problems of a text, without the path of the file.
std::string problems_of(std::string_view text, const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  const LoadResult result = load_text(folder, text, overrides);
  EXPECT_EQ(result.world.has_value(), result.problems.empty());
  std::string problems = text_of(result.problems);
  const std::string path = (folder.path() / "world.yaml").string() + ':';
  for (std::size_t at = 0; (at = problems.find(path, at)) != std::string::npos;)
    problems.erase(at, path.size());
  return problems;
}

TEST(LoadWorld, GivesAnEmptyFileOfSectionsTheDefaults) {
  const Folder folder;
  const LoadResult result = load_text(folder, "{}");
  ASSERT_TRUE(result.world) << text_of(result.problems);
  const World defaults;
  EXPECT_EQ(result.world->name, "world");
  EXPECT_EQ(result.world->robot.mass, defaults.robot.mass);
  EXPECT_EQ(result.world->robot.max_turn_rate, defaults.robot.max_turn_rate);
  EXPECT_EQ(result.world->landmark_sensor.fov, defaults.landmark_sensor.fov);
  EXPECT_EQ(result.world->landmark_sensor.bearing_sd, defaults.landmark_sensor.bearing_sd);
  EXPECT_EQ(result.world->start_estimate.heading_sd, defaults.start_estimate.heading_sd);
  EXPECT_TRUE(result.world->landmarks.empty());
  EXPECT_TRUE(result.world->estimators.empty());
}

TEST(LoadWorld, ReportsProblemsOfAllKindsAtOnceInTheirOrder) {
  EXPECT_EQ(problems_of("seeed: 3\n"
                        "robot:\n"
                        "  start: {x_m: 100}\n"
                        "landmarks:\n"
                        "  placed:\n"
                        "    - {x_m: 5, y_m: 0}\n"
                        "obstacles:\n"
                        "  walls: [{points_m: [[5, -1], [5, 1]]}]\n"
                        "sensors:\n"
                        "  encoders: {rate_hz: 7}\n"
                        "  landmark_sensor: {range_sd_m: -0.1}\n"
                        "drive: {pose_from: truht}\n"),
            "1:1: unknown key 'seeed' (did you mean 'seed'?)\n"
            "3:10: the robot, which reaches 0.315 m around its axle, starts off the ground\n"
            "6:7: the landmark is inside of obstacles.walls.0\n"
            "10:23: the rate must divide physics.step_rate_hz, which is 240 Hz; 7 Hz does not\n"
            "11:33: 'range_sd_m' must be at least 1e-06 and at most 1000 m, not '-0.1'\n"
            "12:20: 'pose_from' must be truth, odometry or one of the estimators, not 'truht' (did you mean "
            "'truth'?)\n");
}

TEST(LoadWorld, RefusesCollisionsOfWhatIsPlacedByHand) {
  EXPECT_NE(problems_of("obstacles: {boxes: [{x_m: 0.5, y_m: 0, size_m: [1, 1]}]}\n")
                .find("starts inside of obstacles.boxes.0"),
            std::string::npos);
  EXPECT_NE(problems_of("landmarks: {placed: [{x_m: 0.2, y_m: 0}]}\n").find("where the robot starts"),
            std::string::npos);
  EXPECT_NE(problems_of("landmarks: {placed: [{x_m: 5, y_m: 0}, {x_m: 5.1, y_m: 0}]}\n")
                .find("overlaps landmarks.placed.0"),
            std::string::npos);
  EXPECT_NE(problems_of("landmarks: {placed: [{x_m: 20, y_m: 0}]}\n").find("not wholly on the ground"),
            std::string::npos);
  EXPECT_NE(problems_of("landmarks: {placed: [{x_m: 5, y_m: 0.1}]}\ndrive: {mode: waypoints, waypoints_m: "
                        "[[0, 0], [9, 0]]}\n")
                .find("stands in the way"),
            std::string::npos);
}

TEST(LoadWorld, ReadsTheEngine) {
  const Folder folder;
  EXPECT_EQ(load_text(folder, "{}").world.value().physics.engine, Engine::bullet);
  const LoadResult result = load_text(folder, "physics: {engine: kinematic}\n");
  ASSERT_TRUE(result.world) << text_of(result.problems);
  EXPECT_EQ(result.world->physics.engine, Engine::kinematic);
  EXPECT_NE(result.resolved.find("engine: kinematic"), std::string::npos);
  EXPECT_NE(problems_of("physics: {engine: kinematics}\n").find("did you mean 'kinematic'?"),
            std::string::npos);
}

TEST(LoadWorld, RefusesForTheKinematicEngineWhatItWouldIgnore) {
  const std::string text =
      "physics:\n"
      "  patches: [{min_m: [5, 5], max_m: [6, 6], friction: 0.1}]\n"
      "obstacles:\n"
      "  boxes: [{x_m: 5, y_m: 0, size_m: [1, 1]}]\n"
      "  walls: [{points_m: [[-5, -1], [-5, 1]]}]\n";
  EXPECT_EQ(problems_of(text), "");
  const std::string or_bullet = ": take them out, or set physics.engine to bullet\n";
  EXPECT_EQ(problems_of(text, {"physics.engine=kinematic"}),
            "2:12: the kinematic engine knows no patches" + or_bullet +
                "4:10: the kinematic engine knows no boxes" + or_bullet +
                "5:10: the kinematic engine knows no walls" + or_bullet);
  EXPECT_EQ(problems_of(text, {"physics.engine=kinematic", "physics.patches=[]", "obstacles={}"}), "");
}

TEST(LoadWorld, RefusesPathsThatCannotBeDriven) {
  const std::string walls = "obstacles: {walls: [{points_m: [[5, -1], [5, 1]]}]}\n";
  EXPECT_NE(problems_of("drive: {mode: waypoints, waypoints_m: [[0, 0], [30, 0]]}\n").find("off the ground"),
            std::string::npos);
  EXPECT_NE(problems_of(walls + "drive: {mode: waypoints, waypoints_m: [[0, 0], [5, 0]]}\n")
                .find("inside of obstacles.walls.0"),
            std::string::npos);
  EXPECT_NE(problems_of(walls + "drive: {mode: waypoints, waypoints_m: [[0, 0], [9, 0]]}\n")
                .find("meets obstacles.walls.0"),
            std::string::npos);
  EXPECT_NE(problems_of("drive: {mode: loop, waypoints_m: [[0, 0], [9, 0], [9, 0]]}\n").find("equal"),
            std::string::npos);
  EXPECT_NE(
      problems_of("drive: {mode: serpentine, min_m: [0, 0], max_m: [9, 9], lane_m: 1e-9}\n").find("lanes"),
      std::string::npos);
  EXPECT_NE(problems_of("drive: {mode: explore, speed_m_s: 3}\n").find("max_speed_m_s"), std::string::npos);
}

TEST(LoadWorld, SaysWhichModeOrPatternAKeyBelongsTo) {
  EXPECT_NE(problems_of("drive: {mode: hold, waypoints_m: [[0, 0]]}\n")
                .find("'waypoints_m' does not belong to mode 'hold', but to 'waypoints', 'loop'"),
            std::string::npos);
  EXPECT_NE(problems_of("landmarks: {generators: [{type: uniform, count: 3, jitter_m: 1}]}\n")
                .find("'jitter_m' does not belong to type 'uniform'"),
            std::string::npos);
  EXPECT_NE(
      problems_of("landmarks: {generators: [{type: unifrom, count: 3}]}\n").find("did you mean 'uniform'?"),
      std::string::npos);
  EXPECT_NE(problems_of("landmarks: {generators: [{count: 3}]}\n").find("'type' is missing"),
            std::string::npos);
}

TEST(LoadWorld, WantsExactlyOneOfCountAndDensity) {
  EXPECT_NE(problems_of("landmarks: {generators: [{type: uniform}]}\n").find("exactly one of"),
            std::string::npos);
  EXPECT_NE(problems_of("landmarks: {generators: [{type: uniform, count: 3, density_per_m2: 1}]}\n")
                .find("exactly one of"),
            std::string::npos);
}

TEST(LoadWorld, SaysAtItsLineWhatAGeneratorCouldNotPlace) {
  const std::string problems = problems_of(
      "landmarks:\n  generators:\n    - {type: uniform, count: 5}\n"
      "    - {type: poisson_disk, count: 1000, distance_m: 5, max_tries: 50}\n");
  EXPECT_EQ(problems.find("4:7: only "), 0U);
  EXPECT_NE(problems.find(" of 1000 landmarks found a free place (max_tries is 50)"), std::string::npos);
}

TEST(LoadWorld, RefusesGeneratorsWithoutAnythingToPlace) {
  EXPECT_NE(
      problems_of("landmarks: {generators: [{type: grid, cell_m: [100, 1]}]}\n").find("to place 0 landmarks"),
      std::string::npos);
  EXPECT_NE(problems_of("landmarks: {generators: [{type: uniform, density_per_m2: 1e9}]}\n").find("at most"),
            std::string::npos);
  EXPECT_NE(problems_of("landmarks: {generators: [{type: corridor}]}\n").find("needs 'points_m'"),
            std::string::npos);
}

TEST(LoadWorld, RefusesRobotsThatCannotBeBuilt) {
  EXPECT_NE(problems_of("robot: {wheel_radius_m: 0}\n"), "");
  EXPECT_NE(problems_of("robot: {wheel_radius_m: 0.3}\n").find("wheels would touch"), std::string::npos);
  EXPECT_NE(problems_of("robot: {caster: {radius_m: 0.15, offset_m: -0.3}}\n").find("does not fit"),
            std::string::npos);
  EXPECT_NE(problems_of("robot: {caster: {offset_m: 0}}\n").find("topples"), std::string::npos);
  EXPECT_NE(problems_of("robot: {mass_kg: 0.5}\n").find("weigh less"), std::string::npos);
}

TEST(LoadWorld, ReadsEstimatorsInTheOrderOfTheFile) {
  const Folder folder;
  const LoadResult result = load_text(
      folder, "estimators:\n  wide: {type: seif_report, theta_x: 16, odometry_sd_factor: 2}\n  ekf: {}\n");
  ASSERT_TRUE(result.world) << text_of(result.problems);
  const auto& estimators = result.world->estimators;
  ASSERT_EQ(estimators.size(), 2U);
  EXPECT_EQ(estimators[0].name, "wide");
  EXPECT_EQ(estimators[0].type, "seif_report");
  EXPECT_EQ(estimators[0].odometry_sd_factor, 2.0);
  EXPECT_EQ(std::get<std::int64_t>(estimators[0].options.at("theta_x")), 16);
  EXPECT_EQ(std::get<std::int64_t>(estimators[0].options.at("K")), 10);
  EXPECT_EQ(estimators[1].type, "ekf");
  EXPECT_EQ(std::get<double>(estimators[1].options.at("gate")), 0.0);
}

TEST(LoadWorld, RefusesEstimatorsThatAreNone) {
  EXPECT_NE(problems_of("estimators: {seif_rport: {}}\n").find("did you mean 'seif_report'?"),
            std::string::npos);
  EXPECT_NE(problems_of("estimators: {mine: {type: efk}}\n").find("did you mean 'ekf'?"), std::string::npos);
  EXPECT_NE(problems_of("estimators: {truth: {type: ekf}}\n").find("taken"), std::string::npos);
  EXPECT_NE(problems_of("estimators: {../x: {type: ekf}}\n").find("no name"), std::string::npos);
  EXPECT_NE(problems_of("estimators: {ekf: {theta_x: 3}}\n").find("does not belong to type 'ekf'"),
            std::string::npos);
  EXPECT_NE(problems_of("estimators: {ekf: }\n").find("must be a map"), std::string::npos);
  EXPECT_NE(problems_of("estimators: {seif_report: {theta_x: 0}}\n").find("at least 1"), std::string::npos);
}

TEST(LoadWorld, ReadsHowARunIsFilmed) {
  const Folder folder;
  const LoadResult result = load_text(folder,
                                      "estimators: {seif: {}, ekf: {}}\n"
                                      "film: {size_px: [640, 360], fps: 25, speed: 2.5, camera: fixed, "
                                      "eye_m: [1, 2, 3], target_m: [4, 5, 0.1],\n"
                                      "  estimators: [ekf], layers: {rays: false, legend: false}}\n");
  ASSERT_TRUE(result.world) << text_of(result.problems);
  const Film& film = result.world->film;
  Film expected{640, 360, 25, 2.5, FilmCamera::fixed, {1, 2, 3}, {4, 5, 0.1}, {"ekf"}, {}};
  expected.layers.rays = false;
  expected.layers.legend = false;
  test::expect_equal(film, expected);
  const LoadResult again = load_world(folder.write("resolved.yaml", result.resolved), {}, fake_estimators());
  ASSERT_TRUE(again.world) << text_of(again.problems);
  test::expect_equal(again.world->film, film);
  test::expect_equal(load_text(folder, "{}").world.value().film, Film{});
}

TEST(LoadWorld, GivesEachLayerOfAFilmItsOwnSwitch) {
  const Folder folder;
  for (const FilmLayer& layer : film_layers) {
    const LoadResult result = load_text(folder, "{}", {"film.layers." + std::string(layer.name) + "=false"});
    ASSERT_TRUE(result.world) << text_of(result.problems);
    Film expected;
    expected.layers.*layer.shown = false;
    test::expect_equal(result.world->film, expected);
  }
}

TEST(LoadWorld, RefusesFilmsThatCannotBeMade) {
  EXPECT_EQ(problems_of("film: {camera: fixed, eye_m: [1, 2, 3], target_m: [1, 2, 3]}\n"),
            "1:30: 'eye_m' must differ from 'target_m', or the camera looks nowhere\n");
  EXPECT_EQ(problems_of("film: {camera: chase, eye_m: [1, 2, 3], target_m: [1, 2, 3]}\n"), "");
  EXPECT_EQ(problems_of("estimators: {ekf: {}, seif: {}}\nfilm: {estimators: [ekf, sief]}\n"),
            "2:26: there is no estimator 'sief' to film (did you mean 'seif'?)\n");
  EXPECT_EQ(problems_of("estimators: {ekf: {}}\n", {"film.estimators=[batch]"}),
            "--set film.estimators=[batch]: there is no estimator 'batch' to film\n");
  EXPECT_EQ(problems_of("{}", {"film.layers.ray=false"}),
            "--set film.layers.ray=false: unknown key 'ray' (did you mean 'rays'?)\n");
  EXPECT_NE(problems_of("film: {camera: overveiw}\n").find("did you mean 'overview'?"), std::string::npos);
}

TEST(LoadWorld, ReadsCommandsBesideTheWorldFile) {
  const Folder folder;
  folder.write("runs/moves.csv", "t,v,omega\n0,0.5,0\n1.5,0.25,-0.1\r\n");
  const LoadResult result = load_text(folder, "drive: {mode: commands, file: runs/moves.csv}\n");
  ASSERT_TRUE(result.world) << text_of(result.problems);
  ASSERT_EQ(result.world->drive.commands.size(), 2U);
  EXPECT_EQ(result.world->drive.commands[1].t, 1.5);
  EXPECT_EQ(result.world->drive.commands[1].omega, -0.1);
  EXPECT_TRUE(std::filesystem::path(result.world->drive.commands_file).is_absolute());
}

TEST(LoadWorld, RefusesEachWrongRowOfCommands) {
  const Folder folder;
  const auto csv = folder.write("moves.csv", "t,v,omega\n0,1,0\n0,1,0\n1,fast,0\n2,1\n3,nan,0\n4,1,0,7\n\n");
  const LoadResult result = load_text(folder, "drive: {mode: commands, file: moves.csv}\n");
  ASSERT_EQ(result.problems.size(), 6U) << text_of(result.problems);
  EXPECT_EQ(to_string(result.problems[1]),
            csv.string() + ":4:1: 'v' must be a number of at most 1000000, not 'fast'");
  EXPECT_NE(problems_of("drive: {mode: commands, file: nothing.csv}\n").find("1:31: "), std::string::npos);
}

TEST(LoadWorld, LooksForCommandsBesideTheFileThatNamesThem) {
  const Folder folder;
  folder.write("base/moves.csv", "t,v,omega\n0,0.5,0\n");
  folder.write("base/world.yaml", "drive: {mode: commands, file: moves.csv}\n");
  const LoadResult result = load_text(folder, "extends: base/world.yaml\n");
  EXPECT_TRUE(result.world) << text_of(result.problems);
}

TEST(LoadWorld, TakesTheLargestAndTheSmallestNumbersWithoutHarm) {
  for (const char* number : {"1e308", "-1e308", "1e-308", "1e5", "-1e5"}) {
    const std::string n = number;
    const auto load_and_forget = [](const std::string& text) { problems_of(text); };
    load_and_forget("robot: {start: {x_m: " + n + "}, wheel_radius_m: " + n + "}\n");
    load_and_forget("landmarks: {placed: [{x_m: " + n + ", y_m: 1, radius_m: " + n +
                    "}, {x_m: 3, y_m: 3}]}\n");
    load_and_forget("obstacles: {walls: [{points_m: [[1, 1], [" + n + ", 2]], thickness_m: " + n + "}]}\n");
    load_and_forget("ground: {size_m: [" + n +
                    ", 1e5]}\nlandmarks: {generators: [{type: uniform, count: 9}]}\n");
    for (const char* key :
         {"ring, count: 5, ring_radius_m", "clusters, count: 5, max_tries: 9, cluster_sd_m",
          "poisson_disk, count: 5, max_tries: 9, distance_m", "uniform, density_per_m2",
          "corridor, points_m: [[1, 5], [5, 5]], spacing_m", "uniform, count: 5, radius_m"}) {
      load_and_forget("landmarks: {generators: [{type: " + std::string(key) + ": " + n + "}]}\n");
    }
    for (const char* key : {"walls", "path", "landmarks"}) {
      load_and_forget("landmarks: {generators: [{type: uniform, count: 5, max_tries: 9, clear_m: {" +
                      std::string(key) + ": " + n + "}}]}\n");
    }
    load_and_forget("drive: {mode: loop, waypoints_m: [[0, 0], [" + n + ", 1], [1, 1]]}\n");
    load_and_forget("drive: {mode: serpentine, min_m: [0, 0], max_m: [9, 9], lane_m: " + n + "}\n");
  }
}

TEST(LoadWorld, NamesOverridesInTheirProblems) {
  EXPECT_EQ(problems_of("{}", {"sensors.landmark_sensor.range_sd_m=-1"}),
            "--set sensors.landmark_sensor.range_sd_m=-1: 'range_sd_m' must be at least 1e-06 and at most "
            "1000 m, not '-1'\n");
  EXPECT_EQ(problems_of("{}", {"robot.mas_kg=3"}),
            "--set robot.mas_kg=3: unknown key 'mas_kg' (did you mean 'mass_kg'?)\n");
  EXPECT_EQ(problems_of("seed: 1\n", {"seed=2", "duration_s=\"5\""}),
            "--set duration_s=\"5\": 'duration_s' must be a number, not the quoted text \"5\"\n");
}

TEST(LoadWorld, DoesNotCheckWhatDependsOnAWrongValue) {
  // The start is unknown, so it cannot be reported as inside the box.
  EXPECT_EQ(
      problems_of("robot: {start: {x_m: here}}\nobstacles: {boxes: [{x_m: 0, y_m: 0, size_m: [1, 1]}]}\n"),
      "1:22: 'x_m' must be a number, not 'here'\n");
}

TEST(LoadWorld, RefusesWhatIsNoMap) {
  for (const char* text : {"[1, 2]", "5", "~", "- a\n- b\n"}) EXPECT_NE(problems_of(text), "") << text;
  EXPECT_FALSE(load_world("/", {}, fake_estimators()).world);
  EXPECT_FALSE(load_world("/no/such/file.yaml", {}, fake_estimators()).world);
}

TEST(LoadWorld, WrapsHeadings) {
  const Folder folder;
  const LoadResult result = load_text(folder, "robot: {start: {heading_deg: 270}}\n");
  ASSERT_TRUE(result.world);
  EXPECT_NEAR(result.world->robot.start.heading, -90 * degree, 1e-15);
  EXPECT_EQ(load_text(folder, "robot: {start: {heading_deg: -180}}\n").world->robot.start.heading,
            180 * degree);
}

TEST(LoadWorld, WritesTheVersionOfTheProgramIntoTheResolvedFile) {
  const Folder folder;
  const auto file = folder.write("world.yaml", "seifbed_version: \"0.0.1\"\n");
  EXPECT_EQ(load_world(file, {}, fake_estimators(), "1.2.3").resolved.find("seifbed_version: \"1.2.3\"\n"),
            0U);
}

// YAML reads this name as a null value unless it is quoted.
TEST(LoadWorld, AnEstimatorMayBeCalledNull) {
  const Folder folder;
  const LoadResult first = load_text(folder, "estimators: {\"null\": {type: ekf}, \"NULL\": {type: seif}}\n");
  ASSERT_TRUE(first.world) << test::text_of(first.problems);
  const LoadResult again = load_text(folder, first.resolved);
  ASSERT_TRUE(again.world) << test::text_of(again.problems) << first.resolved;
  EXPECT_EQ(again.world->estimators.back().name, "NULL");
}

TEST(LoadWorld, RefusesAWorldThatItsRunCouldNotReadAgain) {
  const Folder folder;
  std::string walls = "obstacles:\n  walls:\n";
  for (int i = 0; i < 100; ++i)
    walls += "    - {points_m: [[" + std::to_string(i + 2) + ", 5], [" + std::to_string(i + 2) + ", 9]]}\n";
  const std::string ground = "ground: {size_m: [300, 300]}\n";
  set_limits({.bytes = 12'000});
  const LoadResult small = load_text(folder, ground);
  const LoadResult large = load_text(folder, ground + walls);
  set_limits({});
  EXPECT_TRUE(small.world) << text_of(small.problems);
  EXPECT_FALSE(large.world);
  EXPECT_EQ(large.resolved, "");
  EXPECT_NE(text_of(large.problems).find("with all defaults written out, as a run's folder holds it, this"),
            std::string::npos)
      << text_of(large.problems);
}

}  // namespace
}  // namespace worlds
