#include <gtest/gtest.h>

#include "world_files.hpp"
#include "worlds/gallery.hpp"

namespace worlds {
namespace {

TEST(Gallery, IsFoundByBareNames) {
  EXPECT_EQ(find_world("courtyard").filename(), "courtyard.yaml");
  EXPECT_EQ(find_world("courtyard").parent_path().filename(), "worlds");
  EXPECT_TRUE(load_world("courtyard", {}, test::fake_estimators()).world.has_value());
}

TEST(Gallery, LeavesFilesAndUnknownNamesAsTheyAre) {
  for (const char* name : {"courtyard.yaml", "./courtyard", "no_such_world", "some/courtyard", ""})
    EXPECT_EQ(find_world(name), name);
}

}  // namespace
}  // namespace worlds
