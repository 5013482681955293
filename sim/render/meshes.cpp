#include "sim/render/meshes.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace render {

namespace {

void add_triangle(Mesh& mesh, std::size_t a, std::size_t b, std::size_t c) {
  for (const std::size_t index : {a, b, c}) mesh.indices.push_back(static_cast<std::uint16_t>(index));
}

/// A corner of the prism with the same volume as the cylinder of radius 1.
std::array<float, 2> corner_of(int side, int sides) {
  const double step = 2.0 * std::numbers::pi / sides;
  const double radius = std::sqrt(step / std::sin(step));
  return {static_cast<float>(radius * std::cos(step * side)),
          static_cast<float>(radius * std::sin(step * side))};
}

void add_cap(Mesh& mesh, int sides, float up) {
  const std::size_t first = mesh.vertices.size();
  for (int side = 0; side < sides; ++side) {
    const auto [x, y] = corner_of(side, sides);
    mesh.vertices.push_back({{0.5F * x, 0.5F * y, 0.5F * up}, {0.0F, 0.0F, up}});
  }
  for (std::size_t i = 1; i + 1 < static_cast<std::size_t>(sides); ++i) {
    if (up > 0.0F) {
      add_triangle(mesh, first, first + i, first + i + 1);
    } else {
      add_triangle(mesh, first, first + i + 1, first + i);
    }
  }
}

}  // namespace

Mesh box_mesh() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      const std::size_t first = mesh.vertices.size();
      for (const auto& [u, v] : {std::array{-0.5F, -0.5F}, {0.5F, -0.5F}, {0.5F, 0.5F}, {-0.5F, 0.5F}}) {
        Vertex vertex = {};
        vertex.position[axis] = 0.5F * sign;
        vertex.position[(axis + 1) % 3] = u * sign;  // mirrored, to be counter-clockwise seen from outside
        vertex.position[(axis + 2) % 3] = v;
        vertex.normal[axis] = sign;
        mesh.vertices.push_back(vertex);
      }
      add_triangle(mesh, first, first + 1, first + 2);
      add_triangle(mesh, first, first + 2, first + 3);
    }
  }
  return mesh;
}

Mesh cylinder_mesh(int sides, Bottom bottom) {
  Mesh mesh;
  for (int side = 0; side < sides; ++side) {
    const auto [x, y] = corner_of(side, sides);
    mesh.vertices.push_back({{0.5F * x, 0.5F * y, -0.5F}, {x, y, 0.0F}});
    mesh.vertices.push_back({{0.5F * x, 0.5F * y, 0.5F}, {x, y, 0.0F}});
  }
  for (int side = 0; side < sides; ++side) {
    const auto low = 2 * static_cast<std::size_t>(side);
    const auto next = 2 * static_cast<std::size_t>((side + 1) % sides);
    add_triangle(mesh, low, next, next + 1);
    add_triangle(mesh, low, next + 1, low + 1);
  }
  add_cap(mesh, sides, 1.0F);
  if (bottom == Bottom::closed) add_cap(mesh, sides, -1.0F);
  return mesh;
}

}  // namespace render
