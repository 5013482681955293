#include "harness/report/run_figures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {
namespace {

/// A run of a robot that did not move, with a map of `landmarks` in a row, each with an error of 0.1 m.
class FiguresOfRun : public testing::Test {
 protected:
  void write(int landmarks) const {
    std::string truth = "landmark,x,y,radius\n";
    std::string map = "landmark,x,y,cov_xx,cov_xy,cov_yy\n";
    for (int i = 0; i < landmarks; ++i) {
      truth += std::to_string(i) + "," + std::to_string(i) + ",0,0.1\n";
      map += std::to_string(i) + "," + std::to_string(i) + ",0.1,0.04,0.01,0.09\n";
    }
    test::write_file(folder / "landmarks.csv", truth);
    test::write_file(folder / "ekf_map.csv", map);
    test::write_file(folder / "truth.csv", "t,x,y,theta\n0,0,0,0\n2,0,0,0\n");
    test::write_file(folder / "truth.tum", "0 0 0 0 0 0 0 1\n");
    for (const char* name : {"ekf.tum", "odometry.tum"})
      test::write_file(folder / name, "1 3 4 0 0 0 0 1\n2 0 2 0 0 0 0.5 0.8660254037844386\n");
    test::write_file(folder / "ekf_consistency.csv",
                     "t,nees_pose,nees_landmark,landmarks_scored,landmarks_mapped,memory_bytes\n"
                     "1,0.5,1.5,1,1,1\n2,,,1,1,1\n");
    test::write_file(
        folder / "ekf_times.csv",
        "t,update,motion,measurement,sparsification,mean_recovery\n1,20,1,2,3,4\n2,30,1,2,3,4\n");
  }

  Figure figure(const std::string& id) const {
    const std::vector<Figure> figures = run_figures(folder.path(), {{"ekf", 0x0072B2}});
    const auto found = std::ranges::find(figures, id, &Figure::id);
    return found == figures.end() ? Figure{} : *found;
  }

  static const FigureCurve& curve(const Figure& figure, const std::string& name, Mark mark) {
    return *std::ranges::find_if(figure.curves,
                                 [&](const FigureCurve& c) { return c.name == name && c.mark == mark; });
  }

  TemporaryFolder folder;
};

TEST_F(FiguresOfRun, HoldErrorsAndScoresAndTimesByHand) {
  write(3);
  EXPECT_EQ(curve(figure("position-error"), "ekf", Mark::line).y, (std::vector<double>{5, 2}));
  const FigureCurve heading = curve(figure("heading-error"), "ekf", Mark::line);
  EXPECT_NEAR(heading.y[1], 60.0, 1e-9);
  EXPECT_TRUE(curve(figure("heading-error"), "odometry", Mark::line).is_hidden);
  EXPECT_EQ(curve(figure("nees-pose"), "ekf", Mark::line).x, (std::vector<double>{1}));
  EXPECT_EQ(curve(figure("nees-map"), "ekf", Mark::line).y, (std::vector<double>{1.5}));
  EXPECT_NEAR(figure("nees-pose").bands[0].high, 9.348 / 3, 1e-3);
  EXPECT_NEAR(figure("nees-map").bands[0].low, 0.0506 / 2, 1e-3);
  EXPECT_EQ(curve(figure("update-time"), "ekf", Mark::thin_line).y, (std::vector<double>{20, 30}));
}

TEST_F(FiguresOfRun, EllipsesAreOfTwoStandardDeviations) {
  write(1);
  const FigureCurve ellipse = curve(figure("map"), "ekf", Mark::thin_line);
  const Eigen::Matrix2d P{{0.04, 0.01}, {0.01, 0.09}};
  double right = 0.0;
  for (std::size_t i = 0; i + 1 < ellipse.x.size(); ++i) {
    const Eigen::Vector2d d(ellipse.x[i], ellipse.y[i] - 0.1);
    EXPECT_NEAR(d.dot(P.inverse() * d), 4.0, 1e-9);
    right = std::max(right, d.x());
  }
  EXPECT_NEAR(right, 2 * 0.2, 0.005) << "its reach is twice the standard deviation along x";
  EXPECT_TRUE(std::isnan(ellipse.x.back())) << "the next one begins anew";
}

TEST_F(FiguresOfRun, AMapShowsAllThatIsSolid) {
  write(1);
  worlds::World world = test::small_world();
  world.physics.engine = worlds::Engine::bullet;
  world.walls = {{.points = {{0, 0}, {4, 0}, {4, 2}}, .thickness = 0.2}};
  world.boxes = {{.centre = {.position = {1, 2}, .heading = std::numbers::pi / 2}, .size = {2, 1}}};
  world.physics.patches = {{.min = {-1, -2}, .max = {3, 4}}};
  const Figure map = run_figures(folder.path(), {{"ekf", 0x0072B2}}, &world).front();
  ASSERT_EQ(map.areas.size(), 4U) << "a patch, a box, and two legs of the wall";
  EXPECT_FALSE(map.areas[0].is_solid);
  EXPECT_EQ(map.areas[0].x, (std::vector<double>{-1, 3, 3, -1}));
  const auto reach = [](const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return std::pair(low, high);
  };
  const auto expect_reach = [&](const std::vector<double>& values, double low, double high) {
    EXPECT_NEAR(reach(values).first, low, 1e-9);
    EXPECT_NEAR(reach(values).second, high, 1e-9);
  };
  expect_reach(map.areas[1].x, 0.5, 1.5);
  expect_reach(map.areas[1].y, 1, 3);
  expect_reach(map.areas[2].y, -0.1, 0.1);
  expect_reach(map.areas[3].x, 3.9, 4.1);
  EXPECT_EQ(map.discs.x.size(), world.landmarks.size());
  EXPECT_EQ(map.discs.radius.front(), world.landmarks.front().radius);
  world.physics.engine = worlds::Engine::kinematic;
  EXPECT_TRUE(run_figures(folder.path(), {}, &world).front().discs.x.empty()) << "points block nothing";
}

TEST_F(FiguresOfRun, ALandmarkTellsItsIdTruthAndSigma) {
  write(2);
  test::write_file(folder / "landmarks.csv", "landmark,x,y,radius\n1,1,0,0.1\n");
  const Figure map = figure("map");
  EXPECT_TRUE(curve(map, "ekf", Mark::thin_line).is_silent);
  const LandmarkTips tips = curve(map, "ekf", Mark::crosses).landmarks.value();
  EXPECT_EQ(tips.id, (std::vector<std::int64_t>{0, 1}));
  EXPECT_TRUE(std::isnan(tips.true_x[0])) << "the world does not have it";
  EXPECT_EQ(tips.true_x[1], 1);
  EXPECT_EQ(tips.true_y[1], 0);
  EXPECT_NEAR(tips.sd_x[1], 0.2, 1e-12);
  EXPECT_NEAR(tips.sd_y[1], 0.3, 1e-12);
}

TEST_F(FiguresOfRun, OfALargeMapTheSameLandmarksAreDrawnByAll) {
  write(5'000);
  const Figure map = figure("map");
  const FigureCurve truth = curve(map, "truth", Mark::circles);
  EXPECT_EQ(truth.x.size(), 4'000U);
  EXPECT_EQ(curve(map, "ekf", Mark::crosses).x, truth.x);
  EXPECT_EQ(
      std::ranges::count_if(curve(map, "ekf", Mark::thin_line).x, [](double x) { return std::isnan(x); }),
      500);
}

}  // namespace
}  // namespace harness
