#include "pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "scenes.hpp"
#include "sim/render/renderer.hpp"

namespace render::test {

Image drawn(const Scene& scene, int width, int height) {
  Renderer renderer(width, height);
  Image image;
  renderer.draw(scene, image);
  return image;
}

Scene blank(const Camera& camera) {
  Scene scene = bare(320, 180, camera);
  scene.sky = white;
  scene.ground.size = {1e4, 1e4};
  scene.ground.grid = 0.0;
  scene.ground.colour = white;
  scene.shadows = false;
  return scene;
}

double darkness(const Image& image, int x, int y) { return 1.0 - image.pixel(x, y)[1] / 255.0; }

double ink(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += darkness(image, x, y);
  }
  return sum;
}

Difference difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return {255.0, 1.0};
  Difference difference;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int largest = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int off = std::abs(a.rgb[i + channel] - b.rgb[i + channel]);
      difference.mean += off;
      largest = std::max(largest, off);
    }
    difference.share += largest > 24 ? 1.0 : 0.0;
  }
  const auto channels = static_cast<double>(a.rgb.size());
  return {difference.mean / channels, 3.0 * difference.share / channels};
}

Eigen::Vector2d projected(const Camera& camera, const Eigen::Vector3d& p_world, int width, int height) {
  const Eigen::Vector3d forward = (camera.target - camera.eye).normalized();
  const Eigen::Vector3d right = forward.cross(camera.up).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  const Eigen::Vector3d p = p_world - camera.eye;
  const double half =
      camera.height > 0.0 ? 0.5 * camera.height : std::tan(0.5 * camera.field_of_view) * forward.dot(p);
  const double scale = 0.5 * height / half;  // [px/m]
  return {0.5 * width + scale * right.dot(p), 0.5 * height - scale * up.dot(p)};
}

}  // namespace render::test
