// Lines with round ends on the image: the strokes and dots of the world, and the polylines of the overlay.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/render/projection.hpp"
#include "sim/render/targets.hpp"
#include "sim/render/vertex_array.hpp"

namespace render {

struct Capsule {
  Eigen::Vector3f a = Eigen::Vector3f::Zero();  // [px], [px], depth [-1, 1]
  Eigen::Vector3f b = Eigen::Vector3f::Zero();
  float width = 0.0F;  // [px]
  // The bisectors at the ends where a polyline continues, so that each pixel at a joint belongs to one of the
  // two lines. 0: the line ends there.
  Eigen::Vector2f cut_a = Eigen::Vector2f::Zero();
  Eigen::Vector2f cut_b = Eigen::Vector2f::Zero();
  Rgba colour;
};

class CapsulePainter {
 public:
  explicit CapsulePainter(const Gl& gl);
  /// Paints over everything.
  void paint(const std::vector<Capsule>& capsules, const Frame& frame, Rows rows);
  /// Paints behind things of the layer that are nearer to the camera.
  void paint_behind(const Targets& layer, const std::vector<Capsule>& capsules, const Frame& frame);

 private:
  Program over_;
  Program behind_;
  VertexArray array_;
};

void append_stroke(const Stroke& stroke, const Projection& projection, const Frame& frame,
                   std::vector<Capsule>& capsules);
void append_dot(const Dot& dot, const Projection& projection, std::vector<Capsule>& capsules);
void append_polyline(const Polyline& line, std::vector<Capsule>& capsules);

}  // namespace render
