#include "harness/report/run_figures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
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
