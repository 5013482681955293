// How the parts of a frame share the image.
#pragma once

#include <optional>
#include <vector>

#include "harness/film/chart.hpp"
#include "worlds/world.hpp"

namespace harness {

struct Layout {
  float scale = 1.0F;  // [-] of lengths that are meant for an image of 1280 x 720
  std::optional<Frame> caption;
  std::vector<Frame> views;     // side by side, one for each estimator; one if there is none
  std::optional<Frame> panel;   // below the views, and in it from left to right:
  std::vector<Frame> matrices;  // one for each estimator
  std::optional<Frame> times, pose_error, legend;
};

Layout layout_of(const worlds::Film& film, int estimators);

}  // namespace harness
