#include "harness/film/legend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "harness/film/paint.hpp"

namespace harness {
namespace {

std::string words_of(const worlds::FilmLayers& layers, const LegendFacts& facts,
                     const std::vector<Shown>& shown) {
  std::string words;
  for (const LegendEntry& entry : legend_entries(layers, facts, shown)) words += entry.words + "; ";
  return words;
}

const std::vector<Shown> seif_and_batch = {{"seif", palette::green, true}, {"batch", palette::purple, false}};

TEST(Legend, ExplainsAllThatIsDrawn) {
  const LegendFacts everything{true, true, true, true, true, true, true};
  EXPECT_EQ(words_of({}, everything, seif_and_batch),
            "true path; odometry alone; path of seif; path of batch; 2σ: where it may be; 3σ of seif; "
            "3σ of batch; error; landmark, true; landmark, estimated; active: tied to robot; link of "
            "information; range of the sensor; seen; hidden; false detection; wall or box; other friction; ");
}

TEST(Legend, ExplainsNothingThatIsNotDrawn) {
  EXPECT_EQ(words_of({}, {}, {{"ekf", palette::blue, false}}),
            "odometry alone; path of ekf; 2σ: where it may be; 3σ of ekf; landmark, estimated; seen; ");
  EXPECT_EQ(words_of({}, {}, {}), "odometry alone; seen; ");
  worlds::FilmLayers layers;
  layers.links = layers.active = layers.ellipses = layers.rays = layers.pose_error = false;
  EXPECT_EQ(words_of(layers, {}, seif_and_batch),
            "odometry alone; path of seif; path of batch; landmark, estimated; ");
}

TEST(Legend, KnowsWhatTheWorldHolds) {
  worlds::World world;
  LogDescription log;
  EXPECT_FALSE(legend_facts(world, true, log).has_obstacles);
  EXPECT_FALSE(legend_facts(world, true, log).has_patches);
  EXPECT_FALSE(legend_facts(world, true, log).has_false_detections);
  EXPECT_FALSE(legend_facts(world, true, log).has_true_landmarks);
  EXPECT_TRUE(legend_facts(world, true, log).has_hidden);
  world.physics.engine = worlds::Engine::kinematic;
  EXPECT_FALSE(legend_facts(world, true, log).has_hidden);
  world.walls = {{.points = {{0.0, 0.0}, {1.0, 0.0}}}};
  world.physics.patches = {{.min = {0.0, 0.0}, .max = {1.0, 1.0}}};
  world.landmark_sensor.false_detections = 0.1;
  log.landmarks = {TrueLandmark{}};
  EXPECT_TRUE(legend_facts(world, true, log).has_obstacles);
  EXPECT_TRUE(legend_facts(world, true, log).has_patches);
  EXPECT_TRUE(legend_facts(world, true, log).has_false_detections);
  EXPECT_TRUE(legend_facts(world, true, log).has_true_landmarks);
  EXPECT_FALSE(legend_facts(world, false, log).has_obstacles);
}

TEST(Legend, StaysInItsFrame) {
  const LegendFacts everything{true, true, true, true, true, true, true};
  const Frame frame{100.0F, 50.0F, 330.0F, 156.0F};
  std::vector<render::OverlayItem> overlay;
  append_legend(frame, 1.0F, legend_entries({}, everything, seif_and_batch), overlay);
  float lowest = 0.0F;
  float highest = 1000.0F;
  for (const render::OverlayItem& item : overlay) {
    const render::Text* const text = std::get_if<render::Text>(&item);
    if (text == nullptr) continue;
    lowest = std::max(lowest, text->position.y());
    highest = std::min(highest, text->position.y() - text->size);
    EXPECT_GT(text->size, 10.0F);
  }
  EXPECT_GT(highest, frame.y);
  EXPECT_LT(lowest, frame.y + frame.height - 4.0F);
}

}  // namespace
}  // namespace harness
