#include "harness/stress/stress_plot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::read_file;

std::vector<StageScaling> two_stages() {
  return {{.name = "seif", .landmarks = {100, 1'000}, .us = {40, 41}, .slope = {}},
          {.name = "it's \"$(mine)\" `too`", .landmarks = {100, 1'000}, .us = {10, 900}, .slope = {}}};
}

TEST(StressPlot, IsAPngAndAnSvg) {
  const TemporaryFolder parent;
  const std::filesystem::path folder = parent / "it's `mine` $(too)";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(draw_scaling(two_stages(), folder), "");
  EXPECT_TRUE(read_file(folder / "time.png").starts_with("\x89PNG"));
  const std::string svg = read_file(folder / "time.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("seif"), std::string::npos);
  EXPECT_NE(svg.find("`too`"), std::string::npos) << "a name is only a name";
}

TEST(StressPlot, NeedsMoreThanOneNumberOfLandmarks) {
  const TemporaryFolder folder;
  EXPECT_EQ(draw_scaling({{.name = "seif", .landmarks = {100}, .us = {40}, .slope = {}}}, folder.path()), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(StressPlot, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string path = getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const std::string complaint = draw_scaling(two_stages(), folder.path());
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(complaint.find("gnuplot-nox"), std::string::npos) << complaint;
}

}  // namespace
}  // namespace harness
