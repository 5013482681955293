// A scene to be drawn, as plain values: a world seen by one or more cameras, and a flat overlay on top. World
// frame: x east, y north, z up. Pixels count from the upper left corner of the image, x to the right, y down.
// All lengths in pixels are of the image as it is written.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "sim/render/colour.hpp"
#include "sim/render/overlay.hpp"

namespace render {

struct Camera {
  Eigen::Vector3d eye = {0.0, -10.0, 10.0};          // p_world [m]
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  // p_world [m]
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();     // [-] not along the line of sight
  double field_of_view = 0.7;                        // [rad] vertical angle of view
  double height = 0.0;  // [m] visible height, without perspective; 0: perspective
};

enum class Shape {
  box,       // edges along x, y, z
  cylinder,  // around the z axis
};

/// A shape of the given size, centred on its own origin.
struct Solid {
  Shape shape = Shape::box;
  Eigen::Isometry3d T_world_solid = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  // [m] of its bounding box
  Colour colour;
};

/// An upright cylinder that stands on the ground. A scene may have very many of them.
struct Post {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world [m]
  float radius = 0.1F;                                 // [m]
  float height = 0.5F;                                 // [m]
  Colour colour;
};

/// A straight line with round ends.
struct Stroke {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  // p_world [m]
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    // p_world [m]
  float width = 2.0F;                              // [px]
  Colour colour;
};

/// A horizontal ellipse, or a sector of it: the points centre + axes (r cos a, r sin a), r <= 1, |a| <=
/// half_angle.
struct Ellipse {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    // p_world [m]
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();  // (2 x 2) [m]
  double half_angle = std::numbers::pi;                // [rad]
  float outline_width = 1.5F;                          // [px]
  Colour outline;
  Colour fill;
};

/// A disk that faces the camera and keeps its size on the image.
struct Dot {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // p_world [m]
  float radius = 3.0F;                               // [px]
  Colour colour;
};

/// Flat marks. They are painted in this order: ellipses, strokes, dots.
struct Marks {
  std::vector<Ellipse> ellipses;
  std::vector<Stroke> strokes;
  std::vector<Dot> dots;
};

/// Things of the world. Solids and posts throw shadows.
struct Things {
  std::vector<Solid> solids;
  std::vector<Post> posts;
  Marks marks;         // hidden by solids and posts in front of them
  Marks marks_on_top;  // visible through everything
};

struct Ground {
  Eigen::Vector2d size = {40.0, 40.0};  // [m] centred on the origin
  double grid = 1.0;                    // [m] between lines; every fifth line is stronger; 0: no lines
  Colour colour = {0.93F, 0.94F, 0.95F};
  Colour lines = {0.80F, 0.82F, 0.84F};
};

/// A part of the image: one camera's view.
struct View {
  int x = 0;       // [px] of its left edge
  int y = 0;       // [px] of its upper edge
  int width = 0;   // [px]
  int height = 0;  // [px]
  Camera camera;
  Things things;  // seen only in this view
};

/// The description of a whole image.
struct Scene {
  Colour sky = {0.98F, 0.985F, 0.99F};  // distant ground fades into this colour, too
  Ground ground;
  bool shadows = true;
  Things things;  // seen in every view
  std::vector<View> views;
  std::vector<OverlayItem> overlay;  // painted in this order, over all views
};

}  // namespace render
