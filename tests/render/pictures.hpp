// Functions that measure pixels.
#pragma once

#include <functional>
#include <string>

#include "sim/render/image.hpp"
#include "sim/render/scene.hpp"

namespace render::test {

constexpr Colour white = {1.0F, 1.0F, 1.0F};
constexpr Colour black = {0.0F, 0.0F, 0.0F};
constexpr Colour none = {0.0F, 0.0F, 0.0F, 0.0F};

/// Draws a scene of one view with a new renderer.
Image drawn(const Scene& scene, int width, int height);

/// 320 x 180 px, with white ground and sky, no grid and no shadows: everything dark is a mark.
Scene blank(const Camera& camera);

/// The darkness of a pixel, from 0 (white) to 1 (black).
double darkness(const Image& image, int x, int y);
/// The sum of the darkness over all pixels. [px^2]
double ink(const Image& image);

struct Difference {
  double mean = 0.0;   // mean difference of a channel, of 255
  double share = 0.0;  // share of the pixels that differ by more than 24 in a channel
};
Difference difference(const Image& a, const Image& b);

/// The position of a point of the world on an image of this size, from the upper left corner. An independent
/// implementation of the camera's definition. [px]
Eigen::Vector2d projected(const Camera& camera, const Eigen::Vector3d& p_world, int width, int height);

}  // namespace render::test
