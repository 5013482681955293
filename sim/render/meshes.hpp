// The basic shapes of things, with size 1 and centred on the origin.
#pragma once

#include <cstdint>
#include <vector>

namespace render {

struct Vertex {
  float position[3];
  float normal[3];
};

/// Triangles, counter-clockwise when seen from outside.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint16_t> indices;
};

enum class Bottom { closed, open };

Mesh box_mesh();
/// Around the z axis. The open bottom is for cylinders that stand on the ground.
Mesh cylinder_mesh(int sides, Bottom bottom);

}  // namespace render
