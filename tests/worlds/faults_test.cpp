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
    EXPECT_FALSE(result.world) << text;
    EXPECT_NE(test::text_of(result.problems).find(message), std::string::npos)
        << text << '\n'
        << test::text_of(result.problems);
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
