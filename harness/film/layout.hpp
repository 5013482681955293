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
  std::vector<Frame> views;    // side by side, one for each estimator; a single one without estimators
  std::optional<Frame> panel;  // below the views; it holds, from left to right:
  std::vector<std::optional<Frame>> matrices;  // for each estimator; empty if it keeps no matrix
  std::optional<Frame> times, pose_error, legend;
};

/// `keeps_matrix` says of each estimator that is filmed whether it keeps a matrix that can be shown.
Layout layout_of(const worlds::Film& film, const std::vector<bool>& keeps_matrix);

}  // namespace harness
