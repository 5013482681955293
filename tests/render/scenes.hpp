// Scenes that tests and the benchmark draw.
#pragma once

#include "sim/render/scene.hpp"

namespace render::test {

/// A walled yard of 24 m with posts, a robot made of boxes and wheels, an estimator's belief, and an overlay.
/// It has two views, one from behind and one from above, and the size of the films.
Scene yard(int posts, int marks);

/// One view over the whole image.
Scene bare(int width, int height, const Camera& camera);

/// A camera `height` metres above the target that looks straight down, with north at the top.
Camera from_above(const Eigen::Vector3d& target, double height);

}  // namespace render::test
