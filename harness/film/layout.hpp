// Divides the image among the parts of a frame.
#pragma once

#include <optional>
#include <vector>

#include "harness/film/chart.hpp"
#include "worlds/world.hpp"

namespace harness {

struct Layout {
  float scale = 1.0F;  // [-] factor for lengths, which are given for an image of 1280 x 720 px
  std::optional<Frame> caption;
  std::vector<Frame> views;     // side by side, one for each estimator; a single one without estimators
  std::optional<Frame> panel;   // below the views; it holds, from left to right:
  std::vector<Frame> matrices;  // one for each estimator
  std::optional<Frame> times, pose_error, legend;
};

Layout layout_of(const worlds::Film& film, int estimators);

}  // namespace harness
