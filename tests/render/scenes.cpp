#include "scenes.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace render::test {

namespace {

using std::numbers::pi;
constexpr Colour wall = {0.86F, 0.87F, 0.88F};
constexpr Colour dark = {0.20F, 0.22F, 0.26F};
constexpr Colour blue = {0.16F, 0.42F, 0.75F};
constexpr Colour orange = {0.91F, 0.45F, 0.13F};

Colour faint(Colour colour, float alpha) {
  colour.a = alpha;
  return colour;
}

void add_box(Things& things, const Eigen::Vector3d& centre, const Eigen::Vector3d& size,
             const Colour& colour) {
  Solid solid;
  solid.T_world_solid.translation() = centre;
  solid.size = size;
  solid.colour = colour;
  things.solids.push_back(solid);
}

void add_walls(Things& things) {
  for (const double side : {-1.0, 1.0}) {
    add_box(things, {12.0 * side, 0.0, 0.4}, {0.2, 24.2, 0.8}, wall);
    add_box(things, {0.0, 12.0 * side, 0.4}, {24.2, 0.2, 0.8}, wall);
    add_box(things, {3.0 * side, 6.0, 0.6}, {4.0, 0.2, 1.2}, wall);
    add_box(things, {5.0 * side, -5.0, 0.5}, {1.5, 1.0, 1.0}, wall);
    add_box(things, {7.0, 2.0 * side, 0.75}, {0.8, 0.8, 1.5}, wall);
  }
}

void add_robot(Things& things, const Eigen::Isometry3d& T_world_robot) {
  const auto place = [&](Shape shape, const Eigen::Isometry3d& T_robot_part, const Eigen::Vector3d& size,
                         const Colour& colour) {
    Solid solid;
    solid.shape = shape;
    solid.T_world_solid = T_world_robot * T_robot_part;
    solid.size = size;
    solid.colour = colour;
    things.solids.push_back(solid);
  };
  const auto at = [](double x, double y, double z) {
    return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
  };
  place(Shape::box, at(0.0, 0.0, 0.16), {0.56, 0.36, 0.16}, orange);
  place(Shape::cylinder, at(0.08, 0.0, 0.29), {0.16, 0.16, 0.10}, dark);
  place(Shape::cylinder, at(-0.22, 0.0, 0.04), {0.08, 0.08, 0.08}, dark);
  for (const double side : {-1.0, 1.0}) {
    place(Shape::cylinder, at(0.05, 0.22 * side, 0.1) * Eigen::AngleAxisd(0.5 * pi, Eigen::Vector3d::UnitX()),
          {0.2, 0.2, 0.06}, dark);
  }
}

void add_belief(Things& things, int count, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d centre(22.0 * unit(engine) - 11.0, 22.0 * unit(engine) - 11.0, 0.0);
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(pi * unit(engine)).toRotationMatrix();
    Ellipse ellipse;
    ellipse.centre = centre;
    ellipse.axes = R * Eigen::Vector2d(0.2 + 0.4 * unit(engine), 0.1 + 0.2 * unit(engine)).asDiagonal();
    ellipse.outline = blue;
    ellipse.fill = faint(blue, 0.18F);
    things.marks.ellipses.push_back(ellipse);
    for (int j = 0; j < 5; ++j) {
      Stroke stroke;
      stroke.from = centre;
      stroke.to = centre + Eigen::Vector3d(2.0 * unit(engine) - 1.0, 2.0 * unit(engine) - 1.0, 0.0);
      stroke.width = 1.5F;
      stroke.colour = faint(blue, 0.5F);
      things.marks.strokes.push_back(stroke);
    }
    things.marks_on_top.dots.push_back({centre, 2.0F, blue});
  }
}

void add_posts(Things& things, int count, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> place(-11.0, 11.0);
  for (int i = 0; i < count; ++i) {
    Post post;
    post.position = {place(engine), place(engine)};
    post.radius = 0.08F;
    post.height = 0.6F;
    post.colour = {0.36F, 0.52F, 0.45F};
    things.posts.push_back(post);
  }
}

void add_trail(Things& things) {
  for (int i = 0; i < 60; ++i) {
    const auto at = [](int k) {
      const double angle = 0.05 * k - 3.1;
      return Eigen::Vector3d(6.0 * std::cos(angle), 4.0 * std::sin(angle) - 0.25, 0.0);
    };
    things.marks.strokes.push_back({at(i), at(i + 1), 3.0F, orange});
  }
}

void add_overlay(Scene& scene) {
  auto& overlay = scene.overlay;
  overlay.push_back(Rectangle{{0.0F, 0.0F}, {1280.0F, 48.0F}, {1.0F, 1.0F, 1.0F, 0.92F}});
  overlay.push_back(Rectangle{{0.0F, 582.0F}, {1280.0F, 720.0F}, {1.0F, 1.0F, 1.0F}});
  overlay.push_back(
      Text{{24.0F, 31.0F}, 20.0F, Align::left, Weight::bold, dark, "Sparse extended information filter"});
  overlay.push_back(
      Text{{1256.0F, 31.0F}, 16.0F, Align::right, Weight::regular, dark, "t = 12.3 s · 4× · ±3σ – µ Σ Ω ξ"});
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2f place(24.0F + 155.0F * static_cast<float>(i % 8),
                                600.0F + 22.0F * static_cast<float>(i / 8));
    overlay.push_back(
        Text{place, 14.0F, Align::left, Weight::regular, dark, "landmark " + std::to_string(1000 + i)});
  }
  for (int line = 0; line < 6; ++line) {
    Polyline curve;
    Band band;
    for (int i = 0; i < 400; ++i) {
      const auto x = static_cast<float>(i);
      const float y =
          650.0F + 30.0F * std::sin(0.03F * x + static_cast<float>(line)) + 4.0F * std::sin(0.9F * x);
      curve.points.emplace_back(860.0F + x, y);
      band.points.emplace_back(860.0F + x, y - 10.0F, y + 10.0F);
    }
    curve.colour = faint(line % 2 == 0 ? blue : orange, 0.8F);
    band.colour = faint(curve.colour, 0.08F);
    overlay.push_back(band);
    overlay.push_back(curve);
  }
}

}  // namespace

Camera from_above(const Eigen::Vector3d& target, double height) {
  Camera camera;
  camera.target = target;
  camera.eye = target + 30.0 * Eigen::Vector3d::UnitZ();
  camera.up = Eigen::Vector3d::UnitY();
  camera.height = height;
  return camera;
}

Scene bare(int width, int height, const Camera& camera) {
  Scene scene;
  View view;
  view.width = width;
  view.height = height;
  view.camera = camera;
  scene.views.push_back(view);
  return scene;
}

Scene yard(int posts, int marks) {
  std::mt19937_64 engine(1);
  Scene scene;
  Eigen::Isometry3d T_world_robot = Eigen::Isometry3d::Identity();
  T_world_robot.translate(Eigen::Vector3d(6.0 * std::cos(-0.1), 4.0 * std::sin(-0.1) - 0.25, 0.0));
  T_world_robot.rotate(Eigen::AngleAxisd(1.65, Eigen::Vector3d::UnitZ()));
  add_walls(scene.things);
  add_robot(scene.things, T_world_robot);
  add_posts(scene.things, posts, engine);
  add_belief(scene.things, marks, engine);
  add_trail(scene.things);
  Ellipse sight;
  sight.centre = T_world_robot.translation();
  sight.axes = 5.0 * T_world_robot.linear().topLeftCorner<2, 2>();
  sight.half_angle = 1.0;
  sight.outline = faint(orange, 0.5F);
  sight.fill = faint(orange, 0.08F);
  scene.things.marks.ellipses.push_back(sight);
  View behind;
  behind.y = 48;
  behind.width = 640;
  behind.height = 534;
  behind.camera.eye = T_world_robot * Eigen::Vector3d(-6.0, 0.0, 4.0);
  behind.camera.target = T_world_robot * Eigen::Vector3d(1.5, 0.0, 0.0);
  View above = behind;
  above.x = 640;
  above.camera = from_above({0.0, 0.0, 0.0}, 26.0);
  scene.views = {behind, above};
  add_overlay(scene);
  return scene;
}

}  // namespace render::test
