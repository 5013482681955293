// Ellipses, sectors, strokes and dots are at the positions that geometry gives.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pictures.hpp"
#include "scenes.hpp"

namespace render {
namespace {

using namespace test;
using std::numbers::pi;
constexpr int width = 320;
constexpr int height = 180;

Camera from_behind() {
  Camera camera;
  camera.eye = {1.0, -12.0, 7.0};
  camera.target = {0.0, 0.5, 0.0};
  return camera;
}

/// 16 px per metre.
Camera overhead() { return from_above({0.3, -0.2, 0.0}, 11.25); }

Eigen::Matrix2d axes(double angle, double a, double b) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix() * Eigen::Vector2d(a, b).asDiagonal();
}

Ellipse ellipse(const Eigen::Matrix2d& axes, const Colour& outline, const Colour& fill) {
  Ellipse ellipse;
  ellipse.axes = axes;
  ellipse.outline = outline;
  ellipse.fill = fill;
  return ellipse;
}

Image drawn_ellipse(const Camera& camera, const Ellipse& ellipse) {
  Scene scene = blank(camera);
  scene.things.marks.ellipses.push_back(ellipse);
  return drawn(scene, width, height);
}

/// Points of the boundary in pixels, close to each other.
std::vector<Eigen::Vector2d> curve(const Camera& camera, const Ellipse& ellipse) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 2000; ++i) {
    const double angle = 2.0 * pi * i / 2000;
    const Eigen::Vector2d p = ellipse.axes * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    points.push_back(projected(camera, ellipse.centre + Eigen::Vector3d(p.x(), p.y(), 0.0), width, height));
  }
  return points;
}

double area(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& p = polygon[i];
    const Eigen::Vector2d& q = polygon[(i + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * std::abs(twice);
}

const std::vector<Eigen::Matrix2d> shapes = {axes(0.0, 2.0, 2.0), axes(0.4, 3.0, 1.0), axes(-1.1, 2.5, 0.3),
                                             axes(2.0, 0.5, 1.5), axes(0.7, 0.3, 0.2)};

TEST(Ellipse, OutlineLiesOnTheProjectedCurve) {
  for (const Camera& camera : {overhead(), from_behind()}) {
    for (const Eigen::Matrix2d& shape : shapes) {
      const Ellipse mark = ellipse(shape, black, none);
      const Image image = drawn_ellipse(camera, mark);
      const std::vector<Eigen::Vector2d> points = curve(camera, mark);
      int dark = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          if (darkness(image, x, y) < 0.5) continue;
          ++dark;
          double nearest = 1e9;
          for (const Eigen::Vector2d& p : points)
            nearest = std::min(nearest, (p - Eigen::Vector2d(x + 0.5, y + 0.5)).norm());
          EXPECT_LT(nearest, 1.0) << x << " " << y << "\n" << shape;
        }
      }
      EXPECT_GT(dark, 8);
      for (const Eigen::Vector2d& p : points) {  // and there is no gap
        EXPECT_GT(darkness(image, static_cast<int>(p.x()), static_cast<int>(p.y())), 0.25) << p.transpose();
      }
    }
  }
}

TEST(Ellipse, FillHasTheProjectedArea) {
  for (const Camera& camera : {overhead(), from_behind()}) {
    for (const Eigen::Matrix2d& shape : shapes) {
      const Ellipse mark = ellipse(shape, none, black);
      const double expected = area(curve(camera, mark));
      EXPECT_NEAR(ink(drawn_ellipse(camera, mark)) / expected, 1.0, 0.02) << shape;
    }
  }
}

TEST(Ellipse, OutlineKeepsItsWidth) {
  for (const float wide : {1.5F, 4.0F}) {
    Ellipse mark = ellipse(axes(0.4, 3.0, 1.5), black, none);
    mark.outline_width = wide;
    double length = 0.0;
    const std::vector<Eigen::Vector2d> points = curve(overhead(), mark);
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    EXPECT_NEAR(ink(drawn_ellipse(overhead(), mark)) / (length * static_cast<double>(wide)), 1.0, 0.03);
  }
}

TEST(Ellipse, ThatIsTinyOrFlatStillShows) {
  for (const Eigen::Matrix2d& shape : {axes(0.0, 0.0, 0.0), axes(0.5, 1e-4, 1e-5), axes(0.5, 2.0, 0.0)}) {
    Ellipse mark = ellipse(shape, black, none);
    mark.outline_width = 3.0F;
    const Image image = drawn_ellipse(overhead(), mark);
    const Eigen::Vector2d centre = projected(overhead(), mark.centre, width, height);
    EXPECT_GT(darkness(image, static_cast<int>(centre.x()), static_cast<int>(centre.y())), 0.9) << shape;
    const double length = 2.0 * 16.0 * shape.norm();  // [px]
    EXPECT_NEAR(ink(image), 3.0 * length + 0.25 * pi * 9.0, 0.25 * (3.0 * length + 9.0)) << shape;
  }
}

TEST(Ellipse, AroundTheCameraShowsItsPartBeforeIt) {
  const Camera camera = from_behind();
  Ellipse mark = ellipse(axes(0.3, 20.0, 18.0), none, black);
  mark.centre = {1.0, -14.0, 0.0};  // behind the eye
  const Image image = drawn_ellipse(camera, mark);
  const Eigen::Matrix2d inverse = mark.axes.inverse();
  for (double x = -4.0; x < 5.0; x += 0.7) {
    for (double y = -5.0; y < 14.0; y += 0.7) {
      const Eigen::Vector2d pixel = projected(camera, {x, y, 0.0}, width, height);
      if (!(pixel.x() > 1.0 && pixel.x() < width - 1.0 && pixel.y() > 1.0 && pixel.y() < height - 1.0))
        continue;
      const double r = (inverse * (Eigen::Vector2d(x, y) - mark.centre.head<2>())).norm();
      if (std::abs(r - 1.0) < 0.05) continue;  // the edge itself
      EXPECT_NEAR(darkness(image, static_cast<int>(pixel.x()), static_cast<int>(pixel.y())),
                  r < 1.0 ? 1.0 : 0.0, 0.01)
          << x << " " << y;
    }
  }
}

TEST(Sector, CoversItsAnglesAlone) {
  for (const double half_angle : {0.4, 1.2, 2.5}) {
    Ellipse mark = ellipse(axes(0.8, 4.0, 4.0), none, black);
    mark.half_angle = half_angle;
    const Image image = drawn_ellipse(overhead(), mark);
    EXPECT_NEAR(ink(image) / (half_angle * 64.0 * 64.0), 1.0, 0.02);
    for (int i = -31; i <= 31; ++i) {
      const double angle = 0.1 * i;
      if (std::abs(std::abs(angle) - half_angle) < 0.06) continue;  // the edge itself
      const Eigen::Vector2d p = mark.axes * (0.8 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      const Eigen::Vector2d pixel = projected(overhead(), {p.x(), p.y(), 0.0}, width, height);
      EXPECT_NEAR(darkness(image, static_cast<int>(pixel.x()), static_cast<int>(pixel.y())),
                  std::abs(angle) < half_angle ? 1.0 : 0.0, 0.01)
          << half_angle << " " << angle;
    }
  }
}

/// Expects that everything dark lies within `reach` pixels of the line from a to b. Returns the sum of the
/// darkness.
double ink_along(const Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double reach) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (darkness(image, x, y) < 0.05) continue;
      const Eigen::Vector2d p = Eigen::Vector2d(x + 0.5, y + 0.5) - a;
      const double t = std::clamp(p.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      EXPECT_LT((p - t * (b - a)).norm(), reach) << x << " " << y;
    }
  }
  return ink(image);
}

TEST(Stroke, RunsBetweenItsEnds) {
  for (const Camera& camera : {overhead(), from_behind()}) {
    const Stroke stroke = {{-3.0, -1.0, 0.0}, {2.5, 2.0, 0.7}, 3.0F, black};
    Scene scene = blank(camera);
    scene.things.marks.strokes.push_back(stroke);
    const Eigen::Vector2d a = projected(camera, stroke.from, width, height);
    const Eigen::Vector2d b = projected(camera, stroke.to, width, height);
    const double expected = 3.0 * (b - a).norm() + 0.25 * pi * 9.0;  // with its round ends
    EXPECT_NEAR(ink_along(drawn(scene, width, height), a, b, 2.2) / expected, 1.0, 0.02);
  }
}

TEST(Stroke, ThatBeginsBehindTheCameraShowsItsVisiblePart) {
  const Camera camera = from_behind();
  const Eigen::Vector3d far(1.0, 3.0, 0.0);
  const Eigen::Vector3d behind = camera.eye + Eigen::Vector3d(0.4, -6.0, -1.0);
  Scene whole = blank(camera);
  whole.things.marks.strokes.push_back({far, behind, 3.0F, black});
  Scene visible = blank(camera);
  visible.things.marks.strokes.push_back({far, far + 0.7 * (behind - far), 3.0F, black});
  const Eigen::Vector2d a = projected(camera, far, width, height);
  const Eigen::Vector2d b = projected(camera, far + 0.6 * (behind - far), width, height);
  const Image image = drawn(whole, width, height);
  EXPECT_GT(ink_along(image, a, a + 100.0 * (b - a), 2.2), 100.0);
  Scene reversed = blank(camera);
  reversed.things.marks.strokes.push_back({behind, far, 3.0F, black});
  EXPECT_LT(difference(image, drawn(reversed, width, height)).mean, 0.01);
  EXPECT_GE(ink(image), ink(drawn(visible, width, height)) - 1.0);
}

TEST(Stroke, BehindTheCameraIsNotSeen) {
  const Camera camera = from_behind();
  Scene scene = blank(camera);
  scene.things.marks.strokes.push_back({{-3.0, -20.0, 0.0}, {5.0, -15.0, 30.0}, 3.0F, black});
  scene.things.marks.dots.push_back({{1.0, -20.0, 14.0}, 5.0F, black});
  scene.things.marks.ellipses.push_back(ellipse(axes(0.0, 1.0, 1.0), black, black));
  scene.things.marks.ellipses.back().centre = {1.0, -20.0, 0.0};
  EXPECT_LT(ink(drawn(scene, width, height)), 0.01);
}

TEST(Dot, KeepsItsSize) {
  const Camera camera = from_behind();
  for (const double y : {-3.0, 4.0}) {
    Scene scene = blank(camera);
    scene.things.marks.dots.push_back({{0.5, y, 0.3}, 6.0F, black});
    const Image image = drawn(scene, width, height);
    EXPECT_NEAR(ink(image) / (pi * 36.0), 1.0, 0.02);
    const Eigen::Vector2d p = projected(camera, {0.5, y, 0.3}, width, height);
    EXPECT_EQ(darkness(image, static_cast<int>(p.x()), static_cast<int>(p.y())), 1.0);
  }
}

TEST(Marks, OfTranslucentColourMixEvenly) {
  Scene scene = blank(overhead());
  scene.things.marks.strokes.push_back({{-3.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, 20.0F, {0.0F, 0.0F, 0.0F, 0.5F}});
  scene.things.marks_on_top.strokes.push_back(
      {{0.0, -3.0, 0.0}, {0.0, 3.0, 0.0}, 20.0F, {0.0F, 0.0F, 0.0F, 0.5F}});
  const Image image = drawn(scene, width, height);
  const auto at = [&](double x, double y) {
    const Eigen::Vector2d p = projected(overhead(), {x, y, 0.0}, width, height);
    return darkness(image, static_cast<int>(p.x()), static_cast<int>(p.y()));
  };
  EXPECT_NEAR(at(2.0, 0.0), 0.5, 0.01);
  EXPECT_NEAR(at(0.0, 2.0), 0.5, 0.01);
  EXPECT_NEAR(at(0.0, 0.0), 0.75, 0.01);
}

}  // namespace
}  // namespace render
