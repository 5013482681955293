// Horizontal ellipses and sectors, projected onto the image.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/render/projection.hpp"
#include "sim/render/targets.hpp"
#include "sim/render/vertex_array.hpp"

namespace render {

/// The pixels of an ellipse. A pixel (x, y, 1), relative to `reference`, shows the point (u, v) = (h_x, h_y) /
/// h_z of the unit disk, with h = disk_from_pixel (x, y, 1). In front of the camera h_z > 0.
struct ScreenEllipse {
  Eigen::Vector2f min = Eigen::Vector2f::Zero();  // [px] bounds of the painted pixels
  Eigen::Vector2f max = Eigen::Vector2f::Zero();
  Eigen::Vector2f reference = Eigen::Vector2f::Zero();        // [px]
  Eigen::Matrix3f disk_from_pixel = Eigen::Matrix3f::Zero();  // by columns
  Eigen::Vector3f depth = Eigen::Vector3f::Zero();            // [-1, 1] = depth . (x, y, 1)
  Eigen::Vector2f edge = Eigen::Vector2f::Zero();   // cosine, sine of the half angle; 0: the whole ellipse
  Eigen::Vector2f minor = Eigen::Vector2f::Zero();  // (u, v) of the shorter axis
  float minor_length = 0.0F;                        // [px]
  float outline_width = 0.0F;                       // [px]
  Rgba outline;
  Rgba fill;
};

/// Nothing if no part of the ellipse is on the image.
std::optional<ScreenEllipse> on_screen(const Ellipse& ellipse, const Projection& projection,
                                       const Frame& frame);

class EllipsePainter {
 public:
  explicit EllipsePainter(const Gl& gl);
  /// Paints over everything.
  void paint(const std::vector<ScreenEllipse>& ellipses, const Frame& frame);
  /// Paints behind things of the layer that are nearer to the camera.
  void paint_behind(const Targets& layer, const std::vector<ScreenEllipse>& ellipses, const Frame& frame);

 private:
  Program over_;
  Program behind_;
  VertexArray array_;
};

}  // namespace render
