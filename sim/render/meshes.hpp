// The shapes that things are made of, of size 1 about the origin.
#pragma once

#include <cstdint>
#include <vector>

namespace render {

struct Vertex {
  float position[3];
  float normal[3];
};

/// Triangles, counter-clockwise as seen from outside.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint16_t> indices;
};

enum class Bottom { closed, open };

Mesh box_mesh();
/// About the z axis. An open bottom is for what stands on the ground.
Mesh cylinder_mesh(int sides, Bottom bottom);

}  // namespace render
