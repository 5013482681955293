// The section `faults`: how it is read, and which faults are refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "world_files.hpp"

namespace worlds {
namespace {

using test::Folder;
using test::load_text;

TEST(Faults, OfEveryKindAreRead) {
  const Folder folder;
  const LoadResult result =
      load_text(folder,
                "faults:\n"
                "  - {kind: bad_observation, at_s: 1, value: infinite}\n"
                "  - {kind: outlier, at_s: 2, size_sigma: -100}\n"
                "  - {kind: encoder_jump, at_s: 3, wheel: right, jump_deg: 180}\n"
                "  - {kind: silence, at_s: 4, sensor: encoders, duration_s: 60}\n"
                "  - {kind: kidnapping, at_s: 5.5, x_m: 2, y_m: -3, heading_deg: 90}\n");
  ASSERT_TRUE(result.world) << test::text_of(result.problems);
  const std::vector<Fault>& faults = result.world->faults;
  ASSERT_EQ(faults.size(), 5U);
  EXPECT_EQ(faults[0].kind, FaultKind::bad_observation);
  EXPECT_EQ(faults[0].value, BadValue::infinite);
  EXPECT_EQ(faults[1].kind, FaultKind::outlier);
  EXPECT_EQ(faults[1].size, -100.0);
  EXPECT_EQ(faults[2].wheel, Wheel::right);
  EXPECT_DOUBLE_EQ(faults[2].jump, 180 * degree);
  EXPECT_EQ(faults[3].sensor, FaultySensor::encoders);
  EXPECT_EQ(faults[3].duration, 60.0);
  EXPECT_EQ(faults[4].at, 5.5);
  EXPECT_EQ(faults[4].to.position, Eigen::Vector2d(2, -3));
  EXPECT_DOUBLE_EQ(faults[4].to.heading, 90 * degree);
}

TEST(Faults, ThatPutThingsIntoTheWorldAreRead) {
  const Folder folder;
  const LoadResult result =
      load_text(folder,
                "faults:\n"
                "  - {kind: ice, at_s: 1, min_m: [-1, -2], max_m: [3, 4], friction: 0.05}\n"
                "  - {kind: ice, at_s: 1, min_m: [-1, -2], max_m: [3, 4]}\n"
                "  - {kind: wall, at_s: 2, points_m: [[1, 1], [1, 3], [3, 3]], closed: true, thickness_m: "
                "0.3, height_m: 2}\n"
                "  - {kind: wall, at_s: 2, points_m: [[1, 1], [1, 3]]}\n"
                "  - {kind: landmark, at_s: 3, x_m: 5, y_m: -6, radius_m: 0.25}\n"
                "  - {kind: landmark, at_s: 3, x_m: 5, y_m: -6}\n"
                "  - {kind: option, at_s: 4, estimator: mine, option: theta_x, new_value: 8}\n");
  ASSERT_TRUE(result.world) << test::text_of(result.problems);
  const std::vector<Fault>& faults = result.world->faults;
  ASSERT_EQ(faults.size(), 7U);
  EXPECT_EQ(faults[0].kind, FaultKind::ice);
  EXPECT_EQ(faults[0].patch.min, Eigen::Vector2d(-1, -2));
  EXPECT_EQ(faults[0].patch.max, Eigen::Vector2d(3, 4));
  EXPECT_EQ(faults[0].patch.friction, 0.05);
  EXPECT_EQ(faults[1].patch.friction, FrictionPatch().friction);
  EXPECT_EQ(faults[2].kind, FaultKind::wall);
  EXPECT_EQ(faults[2].wall.points.size(), 3U);
  EXPECT_EQ(faults[2].wall.thickness, 0.3);
  EXPECT_EQ(faults[2].wall.height, 2.0);
  EXPECT_TRUE(faults[2].wall.closed);
  EXPECT_EQ(faults[3].wall.thickness, Wall().thickness);
  EXPECT_FALSE(faults[3].wall.closed);
  EXPECT_EQ(faults[4].kind, FaultKind::landmark);
  EXPECT_EQ(faults[4].landmark.position, Eigen::Vector2d(5, -6));
  EXPECT_EQ(faults[4].landmark.radius, 0.25);
  EXPECT_EQ(faults[5].landmark.radius, Landmark().radius);
  EXPECT_EQ(faults[6].kind, FaultKind::option);
  EXPECT_EQ(faults[6].estimator, "mine");
  EXPECT_EQ(faults[6].option, "theta_x");
  EXPECT_EQ(faults[6].option_value, 8.0);

  const Folder elsewhere;
  const LoadResult again = load_text(elsewhere, result.resolved);
  ASSERT_TRUE(again.world) << test::text_of(again.problems);
  EXPECT_EQ(again.resolved, result.resolved);
}

/// A world with one fault in its second line, and what is said about it.
TEST(Faults, ThatCannotAppearAreRefusedAtTheirLine) {
  const auto problem_of = [](const std::string& fault, const std::string& more) {
    const Folder folder;
    const std::string text =
        test::text_of(load_text(folder, "faults:\n  - {at_s: 1, " + fault + "}\n" + more).problems);
    const std::string path = (folder.path() / "world.yaml").string() + ':';
    return text.starts_with(path) ? text.substr(path.size()) : text;
  };
  const std::string kinematic = "physics: {engine: kinematic}\n";
  const std::string ice = "kind: ice, min_m: [0, 0], max_m: [1, 1]";
  const std::string wall = "kind: wall, points_m: [[1, 1], [2, 2]]";
  EXPECT_EQ(problem_of(ice, kinematic),
            "2:5: the kinematic engine knows no friction; physics.engine: bullet does\n");
  EXPECT_EQ(problem_of(wall, kinematic),
            "2:5: the kinematic engine knows no walls; physics.engine: bullet does\n");
  EXPECT_EQ(problem_of("kind: landmark, x_m: 1, y_m: 1", kinematic), "");
  EXPECT_EQ(problem_of("kind: wall, points_m: [[1, 1], [1, 25]]", ""),
            "2:5: the wall would stand off the ground\n");
  EXPECT_EQ(problem_of("kind: landmark, x_m: -21, y_m: 0", ""),
            "2:5: the landmark would stand off the ground\n");
  for (const char* sensor : {"false_detections_per_scan: 0.1", "misread_probability: 0.1"}) {
    const std::string sensors = "sensors: {landmark_sensor: {" + std::string(sensor) + "}}\n";
    EXPECT_NE(problem_of("kind: landmark, x_m: 1, y_m: 1", sensors).find("2:5: no landmark can appear where"),
              std::string::npos);
    EXPECT_EQ(problem_of(wall, sensors), "");
  }
  EXPECT_NE(problem_of("kind: ice, min_m: [0, 0], max_m: [-1, 1]", "").find("2:"), std::string::npos);
  EXPECT_NE(problem_of("kind: ice, min_m: [0, 0], max_m: [1, 1], friction: 11", "").find("2:66: 'friction'"),
            std::string::npos);
  EXPECT_NE(problem_of("kind: wall, points_m: [[1, 1]]", "").find("'points_m'"), std::string::npos);
  EXPECT_NE(problem_of("kind: wall, points_m: [[1, 1], [1, 1]]", "").find("two corners in a row are equal"),
            std::string::npos);
  EXPECT_NE(problem_of("kind: landmark, x_m: 1", "").find("2:5: the key 'y_m' is missing"),
            std::string::npos);
  EXPECT_NE(
      problem_of("kind: option, estimator: ekf, option: gate", "").find("the key 'new_value' is missing"),
      std::string::npos);
  EXPECT_NE(
      problem_of("kind: option, estimator: ekf, option: gate, new_value: .inf", "").find("2:70: 'new_value'"),
      std::string::npos);
}

TEST(Faults, AreInTheResolvedWorld) {
  const Folder folder;
  const LoadResult first = load_text(folder,
                                     "faults: [{kind: outlier, at_s: 2, size_sigma: 30}, "
                                     "{kind: bad_observation, at_s: 1}]\n");
  ASSERT_TRUE(first.world) << test::text_of(first.problems);
  const LoadResult again = load_text(folder, first.resolved);
  ASSERT_TRUE(again.world) << test::text_of(again.problems);
  ASSERT_EQ(again.world->faults.size(), 2U);
  EXPECT_EQ(again.world->faults.front().size, 30.0);
}

struct Mistake {
  const char* text;
  const char* message;
};

TEST(Faults, WithAMistakeAreRefused) {
  const std::vector<Mistake> mistakes = {
      {"faults: {kind: outlier}", "'faults' must be a list"},
      {"faults: [{at_s: 1}]", "the key 'kind' is missing"},
      {"faults: [{kind: outlier, size_sigma: 3}]", "the key 'at_s' is missing"},
      {"faults: [{kind: kidnaping, at_s: 1}]", "did you mean 'kidnapping'?"},
      {"faults: [{kind: outlier, at_s: 1}]", "the key 'size_sigma' is missing"},
      {"faults: [{kind: outlier, at_s: -1, size_sigma: 3}]", "'at_s' must be at least 0 and"},
      {"faults: [{kind: outlier, at_s: 1, size_sigma: .nan}]", "'size_sigma' must be a finite number"},
      {"faults: [{kind: outlier, at_s: 1, size: 3}]", "unknown key 'size'"},
      {"faults: [{kind: outlier, at_s: 1, size_sigma: 360}]", "half a turn or more"},
      {"faults: [{kind: outlier, at_s: 1, size_sigma: 3, wheel: left}]",
       "'wheel' does not belong to kind 'outlier', but to 'encoder_jump'"},
      {"faults: [{kind: bad_observation, at_s: 1, value: big}]",
       "must be one of not_a_number, infinite, absurd"},
      {"faults: [{kind: encoder_jump, at_s: 1, wheel: caster, jump_deg: 9}]", "must be one of left, right"},
      {"faults: [{kind: silence, at_s: 1, sensor: encoders, duration_s: 0}]", "must be more than 0"},
      {"faults: [{kind: silence, at_s: 1, duration_s: 1}]", "the key 'sensor' is missing"},
      {"faults: [{kind: kidnapping, at_s: 1, x_m: 3}]", "the key 'y_m' is missing"},
      {"faults: [{kind: kidnapping, at_s: 1, x_m: 19.9, y_m: 0}]", "no room: off the ground"},
      {"obstacles: {boxes: [{x_m: 5, y_m: 0, size_m: [1, 1]}]}\n"
       "faults: [{kind: kidnapping, at_s: 1, x_m: 5, y_m: 0.6}]",
       "no room: inside of a box or wall"},
      {"landmarks: {placed: [{x_m: 5, y_m: 0}]}\nfaults: [{kind: kidnapping, at_s: 1, x_m: 5, y_m: 0.2}]",
       "no room: inside of a landmark"},
  };
  const Folder folder;
  for (const auto& [text, message] : mistakes) {
    const LoadResult result = load_text(folder, text);
    test::expect_refused(result, message, text);
  }
}

TEST(Faults, LandmarksThatAreGeneratedLeaveRoomForWhoIsPutThere) {
  const Folder folder;
  const LoadResult result =
      load_text(folder,
                "ground: {size_m: [8, 8]}\n"
                "landmarks: {generators: [{type: grid, cell_m: [0.5, 0.5], skip_blocked: true}]}\n"
                "faults: [{kind: kidnapping, at_s: 1, x_m: 2.25, y_m: 2.25}]\n");
  ASSERT_TRUE(result.world) << test::text_of(result.problems);
  ASSERT_GT(result.world->landmarks.size(), 100U);
  for (const Landmark& landmark : result.world->landmarks)
    EXPECT_GT((landmark.position - Eigen::Vector2d(2.25, 2.25)).norm(), 0.3);
}

}  // namespace
}  // namespace worlds
