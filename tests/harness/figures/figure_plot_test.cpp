#include "harness/figures/figure_plot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "harness/fixtures.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {
namespace {

using test::read_file;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Figure figure_of(const std::string& name) {
  Figure figure{.id = "figure", .title = name, .x = {"time [s]"}, .y = {name, true}};
  figure.bands = {{"95 %", 0.07, 3.1}};
  figure.curves = {{name, 0x0072B2, Mark::line, {0, 1, gap, 2, 3}, {1, 2, gap, 0, 4}},
                   {name, 0x0072B2, Mark::circles, {1}, {2}},
                   {"empty", 0x0072B2, Mark::crosses, {}, {}}};
  return figure;
}

TEST(FigurePlot, IsAPngAndAnSvgWhateverTheNames) {
  const TemporaryFolder folder;
  const std::string name = "it's \"$(mine)\" `too` \n@ {/=30 big}_x";
  EXPECT_EQ(draw(figure_of(name), folder.path()), "");
  EXPECT_TRUE(read_file(folder / "figure.png").starts_with("\x89PNG"));
  const std::string svg = read_file(folder / "figure.svg");
  EXPECT_TRUE(contains(svg, "`too`") && contains(svg, "{/=30 big}_x")) << "a name is only a name";
  EXPECT_TRUE(contains(svg, "#0072b2") || contains(svg, "0, 114, 178"));
}

TEST(FigurePlot, DrawsCategoriesAndMaps) {
  const TemporaryFolder folder;
  Figure figure = figure_of("seif");
  figure.categories = {"a=1", "a='2'"};
  EXPECT_EQ(draw(figure, folder.path()), "");
  EXPECT_TRUE(contains(read_file(folder / "figure.svg"), "a=1"));
  figure.categories.clear();
  figure.is_map = true;
  EXPECT_EQ(draw(figure, folder.path()), "");
}

TEST(FigurePlot, DrawsMatrices) {
  const TemporaryFolder folder;
  const MatrixFigure matrix{.id = "matrix", .title = "ekf", .size = 2, .cells = {255, 0, 0, 255}};
  EXPECT_EQ(draw(matrix, folder.path()), "");
  EXPECT_TRUE(read_file(folder / "matrix.png").starts_with("\x89PNG"));
  EXPECT_TRUE(contains(read_file(folder / "matrix.svg"), "<svg"));
}

TEST(FigurePlot, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string path = getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const std::string complaint = draw(figure_of("seif"), folder.path());
  setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(contains(complaint, "gnuplot-nox")) << complaint;
}

TEST(FigurePlot, SaysWhatGnuplotSays) {
  const TemporaryFolder folder;
  const std::string complaint = draw(figure_of("seif"), folder / "nowhere");
  EXPECT_TRUE(complaint.starts_with("no plot: gnuplot says: ")) << complaint;
  EXPECT_TRUE(contains(complaint, "nowhere")) << complaint;
}

TEST(FigurePlot, GoesWithoutAPictureInAFolderThatGnuplotCannotName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "two\nlines");
  EXPECT_TRUE(contains(draw(figure_of("seif"), folder / "two\nlines"), "a folder with such a name"));
}

}  // namespace
}  // namespace harness
