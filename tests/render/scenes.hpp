// Scenes that tests and the benchmark draw.
#pragma once

#include "sim/render/scene.hpp"

namespace render::test {

/// A walled yard of 24 m with posts, a robot of boxes and wheels, what an estimator believes, and an overlay;
/// in a view from behind and one from above. Of the size of the films.
Scene yard(int posts, int marks);

/// One view over the whole image.
Scene bare(int width, int height, const Camera& camera);

/// From the height of `height` metres straight down, north up.
Camera from_above(const Eigen::Vector3d& target, double height);

}  // namespace render::test
