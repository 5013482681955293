// World files with one mistake each. Each gives one message that says where and what, soon, and with little
// memory.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/recording/run_folder.hpp"
#include "limited_call.hpp"

namespace harness {
namespace {

struct BadWorld {
  const char* name;
  std::string text;
  const char* where;    // line:column; empty if the message is about the whole file
  const char* message;  // a part of the message
};

void PrintTo(const BadWorld& bad, std::ostream* out) { *out << bad.name; }

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// Each line refers nine times to the line before.
std::string billion_laughs() {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string alias = fmt::format("*a{}", i - 1);
    const std::string name = fmt::format("a{}", i);
    bomb += name + ": &" + name + " [" + repeated(alias + ", ", 8) + alias + "]\n";
  }
  return bomb;
}

std::string stairs(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  return text;
}

std::vector<BadWorld> wrong_types() {
  return {
      {"SeedIsText", "seed: many\n", "1:7", "'seed' must be a number"},
      {"SeedIsNegative", "seed: -1\n", "1:7", "'seed' must be at least 0"},
      {"SeedIsAFraction", "seed: 1.5\n", "1:7", "'seed' must be a whole number"},
      {"SeedIsBeyond64Bits", "seed: 18446744073709551616\n", "1:7", "'seed' must be"},
      {"SeedIsAList", "seed: [1, 2]\n", "1:7", "'seed' must be"},
      {"NameIsAMap", "name: {first: a}\n", "1:7", "'name' must be"},
      {"DurationIsQuoted", "duration_s: \"60\"\n", "1:13", "'duration_s' must be"},
      {"DurationIsNothing", "duration_s:\n", "2:1", "'duration_s' must be"},
      {"DurationIsABoolean", "duration_s: true\n", "1:13", "'duration_s' must be"},
      {"RobotIsANumber", "robot: 3\n", "1:8", "'robot' must be a map"},
      {"RobotIsAList", "robot: [1]\n", "1:8", "'robot' must be a map, not a list"},
      {"GroundHasThreeSizes", "ground: {size_m: [1, 2, 3]}\n", "1:18", "'size_m' must be a pair [x, y]"},
      {"LandmarksAreAList", "landmarks: [1, 2]\n", "1:12", "'landmarks' must be a map"},
      {"PlacedIsAMap", "landmarks: {placed: {x_m: 1, y_m: 1}}\n", "1:21", "'placed' must be a list"},
      {"PlacedLacksANumber", "landmarks: {placed: [{x_m: 5}]}\n", "1:22", "the key 'y_m' is missing"},
      {"GeneratorLacksAType", "landmarks: {generators: [{count: 3}]}\n", "1:26", "the key 'type' is missing"},
      {"GeneratorIsOfNoType", "landmarks: {generators: [{type: unifrom, count: 3}]}\n", "1:33",
       "did you mean 'uniform'?"},
      {"CountIsAFraction", "landmarks: {generators: [{type: uniform, count: 2.5}]}\n", "1:49",
       "'count' must be a whole number"},
      {"EngineIsUnknown", "physics: {engine: mujoco}\n", "1:19", "'engine' must be one of bullet, kinematic"},
      {"BooleanIsANumber", "sensors: {encoders: {calibrated: 1}}\n", "1:34",
       "'calibrated' must be true or false"},
      {"WaypointIsANumber", "drive: {mode: waypoints, waypoints_m: [1]}\n", "1:40",
       "'waypoints_m' must be a pair [x, y]"},
      {"WaypointsAreMissing", "drive: {mode: loop}\n", "1:8", "the key 'waypoints_m' is missing"},
      {"EstimatorsAreAList", "estimators: [ekf, seif]\n", "1:13", "'estimators' must be a map, not a list"},
      {"FilmIsOfThree", "film: {estimators: [a, b, c]}\n", "1:20", "'estimators' must have at most 2 names"},
  };
}

std::vector<BadWorld> unknown_keys() {
  return {
      {"UnknownSection", "robto: {}\n", "1:1", "unknown key 'robto' (did you mean 'robot'?)"},
      {"UnknownKey", "robot: {mass: 3}\n", "1:9", "unknown key 'mass'"},
      {"UnknownOption", "estimators: {ekf: {bogus: 1}}\n", "1:20", "unknown key 'bogus'"},
      {"ThetaXAboveThetaMax", "estimators: {seif: {theta_x: 20}}\n", "1:30",
       "'theta_x' must be at most 'theta_max', which is 16, not 20; set both"},
      {"ThetaMaxBelowThetaX", "estimators: {seif_gauge_free: {theta_max: 4, theta_x: 5}}\n", "1:55",
       "'theta_x' must be at most 'theta_max', which is 4, not 5; set both"},
      {"ThetaMaxBelowTheDefault", "estimators: {seif: {theta_max: 4}}\n", "1:20",
       "'theta_x' must be at most 'theta_max', which is 4, not 6; set both"},
      {"UnknownType", "estimators: {mine: {type: ekv}}\n", "1:27", "'ekv' (did you mean 'ekf'?)"},
      {"UnknownSteersman", "drive: {pose_from: nobody}\n", "1:20", "'pose_from' must be truth, odometry or"},
      {"KeyOfAnotherMode", "drive: {mode: hold, lookahead_m: 1}\n", "1:21",
       "'lookahead_m' does not belong to mode 'hold'"},
      {"KeyTwice", "seed: 1\nseed: 2\n", "2:1", "the key 'seed' stands here twice: first in line 1"},
      {"KeyIsAList", "[1, 2]: 3\n", "1:1", "a key must be a plain word"},
      {"EstimatorOutside", "estimators: {../x: {type: ekf}}\n", "1:14", "../x"},
  };
}

std::vector<BadWorld> bad_numbers() {
  return {
      {"MassIsNan", "robot: {mass_kg: .nan}\n", "1:18", "'mass_kg' must be a finite number"},
      {"MassIsInfinite", "robot: {mass_kg: .inf}\n", "1:18", "'mass_kg' must be a finite number"},
      {"MassIsZero", "robot: {mass_kg: 0}\n", "1:18", "'mass_kg' must be more than 0"},
      {"MassIsBeyondDoubles", "robot: {mass_kg: 1e999}\n", "1:18", "'mass_kg' must be a finite number"},
      {"DurationIsNan", "duration_s: nan\n", "1:13", "'duration_s' must be a finite number"},
      {"DurationIsInfinite", "duration_s: -.inf\n", "1:13", "'duration_s' must be a finite number"},
      {"DurationIsHuge", "duration_s: 1e18\n", "1:13", "at most 1000000 s"},
      {"GroundIsHuge", "ground: {size_m: [1e30, 10]}\n", "1:19", "at most 100000 m"},
      {"RangeNoiseIsHuge", "sensors: {landmark_sensor: {range_sd_per_m: 10, max_range_m: 1000}}\n", "1:28",
       "a standard deviation of 1e+04 m; the largest allowed is 1000 m"},
      {"StepRateIsHuge", "physics: {step_rate_hz: 1000000000}\n", "1:25", "at most 10000 Hz"},
      {"AMillionDigits", "duration_s: " + std::string(1'000'000, '9') + "\n", "1:13", "9999999999..."},
      {"RangeSdIsNegative", "sensors: {landmark_sensor: {range_sd_m: -0.1}}\n", "1:41",
       "at least 1e-06 and at most 1000 m"},
      {"ProbabilityIsTwo", "sensors: {landmark_sensor: {miss_probability: 2}}\n", "1:47", "at most 1"},
      {"FieldOfViewIsTwoTurns", "sensors: {landmark_sensor: {fov_deg: 720}}\n", "1:38", "at most 360 deg"},
      {"RangeIsHuge", "sensors: {landmark_sensor: {max_range_m: 1e300}}\n", "1:42", "at most 100000 m"},
      {"StartSdIsInfinite", "start_estimate: {x_sd_m: .inf}\n", "1:26", "must be a finite number"},
      {"OptionIsNan", "estimators: {ekf: {odometry_sd_factor: .nan}}\n", "1:40", "must be a finite number"},
      {"FilmIsHuge", "film: {size_px: [1000000, 64]}\n", "1:18", "at most 7680 px"},
      {"ScoringInterval", "scoring: {interval_s: 0}\n", "1:23", "'interval_s' must be at least 1e-06"},
      {"SampleIsHuge", "scoring: {landmark_sample: 99999999999}\n", "1:28", "at most 1000000"},
  };
}

/// What no estimator could start with, or what would take work and memory without bound.
std::vector<BadWorld> numbers_beyond_sense() {
  return {
      {"SeedIsBeyondIntegers", "seed: 9223372036854775808\n", "1:7", "at most 9223372036854775807, not"},
      {"StartSdIsHuge", "start_estimate: {x_sd_m: 1e200}\n", "1:26", "at most 10000 m"},
      {"StartSdIsTiny", "start_estimate: {x_sd_m: 1e-200}\n", "1:26", "at least 1e-06"},
      {"StartHeadingIsHuge", "start_estimate: {heading_sd_deg: 1e6}\n", "1:34", "at most 180 deg"},
      {"RangeSdIsHuge", "sensors: {landmark_sensor: {range_sd_m: 1e300}}\n", "1:41", "at most 1000 m"},
      {"MountIsFarAway", "sensors: {landmark_sensor: {mount: {x_m: 1e5}}}\n", "1:42", "at most 10 m"},
      {"FalseDetectionsByTheThousand", "sensors: {landmark_sensor: {false_detections_per_scan: 1000}}\n",
       "1:56", "at most 100"},
      {"ScoringByTheNanosecond", "scoring: {interval_s: 1e-300}\n", "1:23", "at least 1e-06"},
      {"FilmWithoutEnd", "film: {speed: 1e-300}\n", "1:15", "'speed' must be 0 or at least 0.001"},
      {"FactorIsHuge", "estimators: {ekf: {odometry_sd_factor: 1e200}}\n", "1:40", "at most 1000000"},
      {"GateIsHuge", "estimators: {ekf: {gate: 1e300}}\n", "1:26", "'gate' must be at"},
  };
}

std::vector<BadWorld> bad_names() {
  return {
      {"NameHasAControlCharacter", "name: \"a\\x01b\"\n", "1:7", "'name' must be a text without control"},
      {"NameHasADelete", "name: \"a\\x7fb\"\n", "1:7", "'name' must be a text without control"},
      {"NameHasANul", "name: \"a\\0b\"\n", "1:7", "'name' must be a text without control"},
      {"NameHasTwoLines", "name: \"a\\nb\"\n", "1:7", "'name' must be one line without tabs"},
      {"NameIsLong", "name: " + std::string(3000, 'a') + "\n", "1:7", "'name' must have at most 200 bytes"},
      {"DescriptionHasANul", "description: \"a\\0b\"\n", "1:14", "'description' must be a text without"},
      {"EstimatorHasALongName", "estimators: {" + std::string(240, 'a') + ": {type: ekf}}\n", "1:14",
       "at most 64 letters, digits, '_' and '-'"},
      {"EstimatorIsAnOption", "estimators: {-rf: {type: ekf}}\n", "1:14", "not beginning with '-'"},
      {"EstimatorCannotAssociate", "sensors: {landmark_sensor: {ids: hidden}}\nestimators:\n  eif: {}\n",
       "3:8", "do not say which landmark they are of"},
  };
}

std::vector<BadWorld> too_much() {
  const std::string ground = "ground: {size_m: [1e5, 1e5]}\n";
  return {
      {"ABillionLandmarks", "landmarks: {generators: [{type: uniform, count: 1000000000}]}\n", "1:49",
       "at most 10000000"},
      {"ABillionByDensity", ground + "landmarks: {generators: [{type: uniform, density_per_m2: 0.1}]}\n",
       "2:26", "1000000000 landmarks: at least 1 and at most 20000000"},
      {"ABillionOnAGrid", ground + "landmarks: {generators: [{type: grid, cell_m: [3, 3]}]}\n", "2:26",
       "at most 20000000"},
      {"GridOfNoSize", "landmarks: {generators: [{type: grid, cell_m: [1e-300, 1e-300]}]}\n", "1:26",
       "to place inf landmarks"},
      {"CorridorOfNoSpacing",
       "landmarks: {generators: [{type: corridor, points_m: [[0, 5], [9, 5]], spacing_m: 1e-300}]}\n", "1:26",
       "at most 20000000"},
      {"MoreThanFindRoom", "landmarks: {generators: [{type: uniform, count: 100000}]}\n", "1:26",
       "landmarks found a free place"},
      {"TriesByTheMillion",
       "landmarks: {generators: [{type: uniform, count: 1000000, max_tries: 1000000, radius_m: 10}]}\n",
       "1:26", "of 1000000 landmarks found a free place"},
      {"ClustersByTheMillion", "landmarks: {generators: [{type: clusters, count: 5, clusters: 10000000}]}\n",
       "1:63", "at most 100000"},
      {"AGridThatScatters",
       "ground: {size_m: [3000, 3000]}\n"
       "landmarks: {generators: [{type: grid, cell_m: [1, 1], jitter_m: 1e9}]}\n",
       "2:65", "'jitter_m' must be at least 0 and at most 1000 m"},
      {"ARingOfMillions", "landmarks: {generators: [{type: ring, count: 10000000}]}\n", "1:26",
       "of 10000000 landmarks found a free place"},
      {"LanesByTheBillion", "drive: {mode: serpentine, min_m: [0, 0], max_m: [9, 9], lane_m: 1e-9}\n", "1:65",
       "more than 10000 lanes"},
      {"TwoMillionItems", "a: [" + repeated("1, ", 2'000'000) + "1]\n", "", "more than 4194304 bytes"},
      {"FiveMillionBytes", "#" + std::string(5'000'000, 'x') + "\n", "", "more than 4194304 bytes"},
  };
}

std::vector<BadWorld> bad_syntax() {
  return {
      {"Empty", "", "1:1", "the document is empty"},
      {"OnlyAComment", "# nothing\n", "1:1", "the document is empty"},
      {"OnlyNull", "~\n", "1:1", "must be a map of sections"},
      {"AWord", "hello\n", "1:1", "must be a map of sections"},
      {"AList", "- 1\n- 2\n", "1:1", "must be a map of sections"},
      {"TwoDocuments", "seed: 1\n---\nseed: 2\n", "1:1", "one document, not several"},
      {"ATag", "seed: !!python/object:os.system 1\n", "1:7", "is not supported"},
      {"ATab", "robot:\n\tmass_kg: 3\n", "2:9", "illegal map value"},
      {"UnclosedMap", "robot: {mass_kg: 3\n", "2:1", "not closed"},
      {"UnclosedList", "ground: {size_m: [3, 4\n", "2:1", "not closed"},
      {"UnclosedQuote", "name: \"abc\n", "2:1", "not closed"},
      {"UnclosedSingleQuote", "name: 'abc\nseed: 3\n", "3:1", "not closed"},
      {"BadIndent", "robot:\n  mass_kg: 3\n wheel_mass_kg: 1\n", "3:2", "end of map not found"},
      {"Json", "{\"seed\": 1, \"sed\": 2}\n", "1:13", "did you mean 'seed'?"},
      {"DeepLists", "a: " + std::string(100'000, '['), "1:36", "nested more than 64 deep"},
      {"DeepMaps", repeated("{a: ", 100'000), "1:253", "nested more than 64 deep"},
      {"DeepStairs", stairs(2000), "65:65", "nested more than 64 deep"},
      {"DeepDashes", repeated("- ", 50'000), "1:129", "nested more than 64 deep"},
      {"BillionLaughs", billion_laughs(), nullptr, "more than 1000000 values"},
      {"QuadraticBlowUp", "a: &a [" + repeated("x,", 10'000) + "x]\nb: [" + repeated("*a,", 10'000) + "*a]\n",
       nullptr, "more than 1000000 values"},
      {"AliasOfItself", "a: &a [*a]\n", "1:8", "an alias cannot stand inside of what it stands for"},
      {"AliasOfNothing", "seed: *nobody\n", "1:7", "the referenced anchor is not defined"},
  };
}

std::vector<BadWorld> bad_bytes() {
  return {
      {"Latin1", "name: M\xfcnchen\n", "1:8", "the byte 0xfc does not belong in a UTF-8 text file"},
      {"Utf16", std::string("\xff\xfes\0e\0e\0d\0", 10), "1:1", "0xff"},
      {"NulByte", std::string("seed: 1\0\n", 9), "1:8", "0x00"},
      {"Overlong", "name: \xc0\xaf\n", "1:7", "0xc0"},
      {"Surrogate", "name: \xed\xa0\x80\n", "1:7", "0xed"},
      {"CutOffCharacter", "name: a\xe2\x82", "1:8", "0xe2"},
      {"EscapeCode", "name: \x1b[31m\n", "1:7", "0x1b"},
      {"Program", test::read_file("/bin/sh").substr(0, 100'000), "1:1", "0x7f"},
  };
}

std::vector<BadWorld> bad_references() {
  return {
      {"ExtendsItself", "extends: world.yaml\n", "1:10", "'extends' goes in a circle"},
      {"ExtendsNothing", "extends: nowhere.yaml\n", "1:10", "nowhere.yaml: there is no such file"},
      {"ExtendsAList", "extends: [a, b]\n", "1:10", "'extends' must name one file"},
      {"ExtendsAFolder", "extends: .\n", "1:10", "this is a directory"},
      {"ExtendsADevice", "extends: /dev/zero\n", "1:10", "this is no regular file"},
      {"ExtendsNoWorld", "extends: /etc/hostname\n", "1:10", "no world file"},
      {"CommandsOfNothing", "drive: {mode: commands, file: nowhere.csv}\n", "1:31", "cannot be read"},
      {"CommandsOfAFolder", "drive: {mode: commands, file: .}\n", "1:31", "cannot be read"},
      {"CommandsOfADevice", "drive: {mode: commands, file: /dev/zero}\n", "1:31", "this is no regular file"},
  };
}

std::vector<BadWorld> bad_worlds() {
  std::vector<BadWorld> all;
  for (const auto& some : {wrong_types(), unknown_keys(), bad_numbers(), numbers_beyond_sense(), bad_names(),
                           too_much(), bad_syntax(), bad_bytes(), bad_references()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// Expects that `validate` says what `run` said.
void expect_not_validated(const TemporaryFolder& folder, const std::string& errors) {
  test::Process process(folder.path(), {"validate", "world.yaml"});
  EXPECT_EQ(process.wait().exit_code, 2);
  EXPECT_EQ(test::read_file(folder / "output"), "");
  EXPECT_EQ(test::read_file(folder / "errors"), errors);
}

/// Expects one line with the message, exit code 2, less than a second of processor time and less than 200 MB.
/// (The memory that a process had before exec counts too, so this test program must stay small.)
void expect_refused(const TemporaryFolder& folder, const std::string& start, const std::string& message) {
  test::Process process(folder.path(), {"run", "world.yaml", "--out", "out"});
  const test::Ended ended = process.wait();
  const std::string errors = test::read_file(folder / "errors");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(test::read_file(folder / "output"), "");
  EXPECT_EQ(std::ranges::count(errors, '\n'), 1) << errors.substr(0, 1000);
  EXPECT_TRUE(errors.starts_with(start)) << errors.substr(0, 1000);
  EXPECT_NE(errors.find(message), std::string::npos) << errors.substr(0, 1000);
  EXPECT_LT(errors.size(), 500U);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  expect_not_validated(folder, errors);
  if (test::is_sanitized()) return;
  EXPECT_LT(ended.cpu_seconds, 1.0);
  EXPECT_LT(ended.peak_bytes, 200e6);
}

class BadWorlds : public testing::TestWithParam<BadWorld> {};

TEST_P(BadWorlds, AreRefusedWithOneWordSoonAndInLittleMemory) {
  const BadWorld& bad = GetParam();
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", bad.text);
  std::string start = bad.where != nullptr && *bad.where == '\0' ? "world.yaml: " : "world.yaml:";
  if (bad.where != nullptr && *bad.where != '\0') start += std::string(bad.where) + ": ";
  expect_refused(folder, start, bad.message);
}

INSTANTIATE_TEST_SUITE_P(Worlds, BadWorlds, testing::ValuesIn(bad_worlds()),
                         [](const auto& bad) { return std::string(bad.param.name); });

TEST(BadWorldTable, HasAtLeastSixtyRows) { EXPECT_GE(bad_worlds().size(), 60U); }

TEST(BadWorldFiles, AFolderIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "world.yaml");
  expect_refused(folder, "world.yaml: ", "this is a directory, not a file");
}

TEST(BadWorldFiles, NothingIsRefused) {
  const TemporaryFolder folder;
  expect_refused(folder, "world.yaml: ", "there is no such file");
}

TEST(BadWorldFiles, LinksInACircleAreRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("other.yaml", folder / "world.yaml");
  std::filesystem::create_symlink("world.yaml", folder / "other.yaml");
  expect_refused(folder, "world.yaml: ", "Too many levels of symbolic links");
}

TEST(BadWorldFiles, WhatCannotBeReadIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/proc/self/mem",
                                  folder / "world.yaml");  // then not even root can read its start
  expect_refused(folder, "world.yaml: ", "the file cannot be read");
}

TEST(BadWorldFiles, DevicesAndPipesAreRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/zero", folder / "world.yaml");
  expect_refused(folder, "world.yaml: ", "this is no regular file");
  std::filesystem::remove(folder / "world.yaml");
  ASSERT_EQ(mkfifo((folder / "world.yaml").c_str(), 0600), 0);
  expect_refused(folder, "world.yaml: ", "this is no regular file");
}

TEST(BadWorldFiles, APipeOfCommandsOrToExtendIsNotWaitedFor) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.yaml").c_str(), 0600), 0);
  test::write_file(folder / "world.yaml", "drive: {mode: commands, file: pipe.yaml}\n");
  expect_refused(folder, "world.yaml:1:31: ", "this is no regular file");
  test::write_file(folder / "world.yaml", "extends: pipe.yaml\n");
  expect_refused(folder, "world.yaml:1:10: ", "this is no regular file");
}

TEST(BadWorldFiles, ACircleOfThreeIsRefused) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", "extends: b.yaml\n");
  test::write_file(folder / "b.yaml", "extends: c.yaml\n");
  test::write_file(folder / "c.yaml", "extends: world.yaml\n");
  expect_refused(folder, "c.yaml:1:10: ", "'extends' goes in a circle: world.yaml -> b.yaml -> c.yaml");
}

TEST(BadWorldFiles, ThousandsOfProblemsAreNotAllTold) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "key" + std::to_string(i) + ": 1\n";
  test::write_file(folder / "world.yaml", text);
  test::Process process(folder.path(), {"validate", "world.yaml"});
  EXPECT_EQ(process.wait().exit_code, 2);
  const std::string errors = test::read_file(folder / "errors");
  EXPECT_EQ(std::ranges::count(errors, '\n'), 51);
  EXPECT_TRUE(errors.ends_with("... and 19950 problems more\n"));
}

}  // namespace
}  // namespace harness
