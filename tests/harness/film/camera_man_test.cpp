#include "harness/film/camera_man.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace harness {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double aspect = 1.2;

CameraBrief brief(worlds::FilmCamera kind) {
  CameraBrief brief;
  brief.kind = kind;
  brief.subject = {{-30.0, -10.0}, {50.0, 12.0}};
  brief.reach = 8.0;
  brief.aspect = aspect;
  return brief;
}

TEST(CameraMan, ShowsTheWholeSubjectInAnOverviewAndFillsItsViewWithIt) {
  for (const double wide : {0.5, 1.2, 2.5}) {
    CameraBrief wanted = brief(worlds::FilmCamera::overview);
    wanted.aspect = wide;
    const Frustum frustum(CameraMan(wanted).camera({}, 0.0), wide);
    Vector2d min(1.0, 1.0);
    Vector2d max(-1.0, -1.0);
    for (const double x : {-30.0, 50.0}) {
      for (const double y : {-10.0, 12.0}) {
        EXPECT_TRUE(frustum.sees({x, y, 0.0}, 0.0)) << x << ' ' << y;
        min = min.cwiseMin(frustum.on_image({x, y, 0.0}));
        max = max.cwiseMax(frustum.on_image({x, y, 0.0}));
      }
    }
    EXPECT_NEAR((max - min).maxCoeff(), 1.88, 0.01) << wide;
    EXPECT_NEAR(max.y() + min.y(), 0.0, 0.01) << wide;
    EXPECT_NEAR(max.x() + min.x(), 0.0, 0.01) << wide;
  }
}

TEST(CameraMan, FillsTheHeightOfItsViewWithAWideSubjectToo) {
  CameraBrief wide = brief(worlds::FilmCamera::overview);
  wide.subject = {{-40.0, -25.0}, {40.0, 25.0}};
  const Frustum frustum(CameraMan(wide).camera({}, 0.0), aspect);
  const double height = frustum.on_image({0.0, 25.0, 0.0}).y() - frustum.on_image({0.0, -25.0, 0.0}).y();
  EXPECT_GT(height, 1.25);  // 1.06 from the side
  EXPECT_LT(height, 1.7);
}

TEST(CameraMan, StaysAtItsPlaceInAnOverview) {
  CameraMan man(brief(worlds::FilmCamera::overview));
  EXPECT_EQ(man.camera({}, 0.0).eye, man.camera({9.0, 9.0, 1.0}, 0.1).eye);
}

TEST(Frustum, KnowsTheLengthOfAMetre) {
  render::Camera camera;
  camera.eye = {0.0, 0.0, 10.0};
  camera.target = {0.0, 0.0, 0.0};
  camera.up = Vector3d::UnitY();
  camera.field_of_view = 2.0 * std::atan(0.5);  // 10 m at the ground
  EXPECT_NEAR(Frustum(camera, 1.0).image_heights_per_metre({3.0, 0.0, 0.0}), 0.1, 1e-12);
  camera.height = 20.0;
  EXPECT_NEAR(Frustum(camera, 1.0).image_heights_per_metre({3.0, 0.0, 0.0}), 0.05, 1e-12);
}

TEST(CameraMan, KeepsTheRobotInViewAsItDrives) {
  for (const worlds::FilmCamera kind :
       {worlds::FilmCamera::chase, worlds::FilmCamera::orbit, worlds::FilmCamera::top}) {
    CameraMan man(brief(kind));
    for (int i = 0; i < 300; ++i) {
      const double angle = 0.02 * i;  // 5 m in a second of film, on a circle
      const seif::Pose2 pose{8.0 * std::cos(angle), 8.0 * std::sin(angle), seif::wrap_angle(angle + M_PI_2)};
      const Frustum frustum(man.camera(pose, i == 0 ? 0.0 : 1.0 / 30.0), aspect);
      EXPECT_TRUE(frustum.sees({pose.x, pose.y, 0.0}, 0.0)) << static_cast<int>(kind) << ' ' << i;
    }
  }
}

TEST(CameraMan, DoesNotJerkWhenTheRobotTurnsOnTheSpot) {
  CameraMan man(brief(worlds::FilmCamera::chase));
  Vector3d last = man.camera({}, 0.0).eye;
  for (int i = 0; i < 100; ++i) {
    const Vector3d eye = man.camera({0.0, 0.0, 2.0}, 1.0 / 30.0).eye;
    EXPECT_LT((eye - last).norm(), 1.0);
    last = eye;
  }
  EXPECT_NEAR(std::atan2(-last.y(), -last.x()), 2.0, 0.05);  // and ends up behind it
}

TEST(Frustum, SeesWhatACameraProjectsIntoItsImage) {
  render::Camera camera;
  camera.eye = {0.0, -10.0, 10.0};
  camera.target = {0.0, 0.0, 0.0};
  camera.field_of_view = 0.8;
  const Frustum frustum(camera, 1.0);
  EXPECT_TRUE(frustum.sees({0.0, 0.0, 0.0}, 0.0));
  EXPECT_FALSE(frustum.sees({0.0, -25.0, 0.0}, 0.0));  // behind
  const double half_width = std::sqrt(200.0) * std::tan(0.4);
  EXPECT_TRUE(frustum.sees({0.99 * half_width, 0.0, 0.0}, 0.0));
  EXPECT_FALSE(frustum.sees({1.01 * half_width, 0.0, 0.0}, 0.0));
  EXPECT_TRUE(frustum.sees({1.01 * half_width, 0.0, 0.0}, 0.5));
}

TEST(Frustum, CoversTheGroundInView) {
  for (const double height : {0.0, 20.0}) {
    render::Camera camera;
    camera.eye = {3.0, -10.0, 10.0};
    camera.target = {5.0, 2.0, 0.0};
    camera.height = height;
    const Frustum frustum(camera, aspect);
    const Area area = frustum.ground(60.0);
    for (double x = -80.0; x <= 80.0; x += 1.0) {
      for (double y = -80.0; y <= 80.0; y += 1.0) {
        const Vector2d p(x, y);
        if ((p - camera.eye.head<2>()).norm() > 40.0 || !frustum.sees({x, y, 0.0}, 0.0)) continue;
        EXPECT_TRUE((p.array() >= area.min.array()).all() && (p.array() <= area.max.array()).all())
            << height << ": " << x << ' ' << y;
      }
    }
  }
}

}  // namespace
}  // namespace harness
