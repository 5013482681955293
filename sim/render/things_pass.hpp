// Draws solids and posts, and their shadows, in one view.
#pragma once

#include <array>
#include <vector>

#include "sim/render/sunlight.hpp"
#include "sim/render/vertex_array.hpp"

namespace render {

class ThingsPass {
 public:
  explicit ThingsPass(const Gl& gl);

  /// Begins a view. Of the things added after this, only those that are seen in the view or throw a shadow into
  /// it are drawn, in as much detail as they need.
  void begin(const Projection& projection, const Sunlight& sunlight);
  void add(const Things& things);

  void draw_shadows();
  /// The areas of the ground on which the shadows may fall.
  const std::vector<Shade>& shades() const { return shades_; }
  void draw();

 private:
  /// A mesh, scaled and placed.
  struct Instance {
    Eigen::Matrix3f axes;  // columns: edges of the bounding box, relative to the origin [m]
    Eigen::Vector3f centre;
    Rgba colour;
  };

  /// A post that is too small to be drawn as a shape.
  struct Speck {
    Eigen::Vector3f centre;
    float size;  // [px]
    Rgba colour;
  };

  enum Kind { box, cylinder, fine_post, coarse_post, kinds };

  struct Drawn {
    explicit Drawn(VertexArray array) : vertices(array) {}
    VertexArray vertices;
    std::vector<Instance> seen;
    std::vector<Instance> throwing;
  };

  void add(const Solid& solid);
  void add(const Post& post);
  void throw_shadow(Drawn& drawn, const Instance& instance);

  const Gl& gl_;
  Program shape_;
  Program shadow_;
  Program speck_;
  std::array<Drawn, kinds> drawn_;
  VertexArray speck_vertices_;
  std::vector<Speck> specks_;
  std::vector<Shade> shades_;
  const Projection* projection_ = nullptr;
  const Sunlight* sunlight_ = nullptr;
};

}  // namespace render
