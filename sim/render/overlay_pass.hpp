// Draws the overlay over the whole image.
#pragma once

#include <vector>

#include "sim/render/capsules.hpp"
#include "sim/render/glyph_atlas.hpp"

namespace render {

class OverlayPass {
 public:
  explicit OverlayPass(const Gl& gl);
  void draw(const std::vector<OverlayItem>& items, const Frame& frame);

 private:
  using Box = Eigen::Matrix<float, 4, 1, Eigen::DontAlign>;

  /// A rectangle filled with a colour times a part of the glyph atlas.
  struct Patch {
    Box box;    // [px] from, to
    Box atlas;  // [px] from, to
    Rgba colour;
  };

  /// The area between two lines, from one x to another.
  struct Slice {
    Eigen::Vector3f from;  // x, y of the first line, y of the second [px]
    Eigen::Vector3f to;
    Rgba colour;
  };

  void add(const Rectangle& rectangle);
  void add(const Text& text);
  void add(const Polyline& line);
  void add(const Band& band);
  void add(const Raster& raster);
  /// Consecutive items of one kind are painted together; this function paints those that wait.
  void flush();
  void paint_patches();
  void paint_slices();

  const Gl& gl_;
  Program patch_;
  Program slice_;
  Program raster_;
  VertexArray patch_vertices_;
  VertexArray slice_vertices_;
  VertexArray raster_vertices_;
  CapsulePainter capsule_painter_;
  GlyphAtlas atlas_;
  GLuint raster_texture_ = 0;
  std::vector<Patch> patches_;
  std::vector<Slice> slices_;
  std::vector<Capsule> capsules_;
  Frame frame_;
};

}  // namespace render
