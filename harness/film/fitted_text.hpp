// Text cut to the available width.
#pragma once

#include <string>

#include "sim/render/scene.hpp"

namespace harness {

/// The text, cut with an ellipsis if it is wider than `room` [px].
std::string fitted(std::string text, float size, render::Weight weight, float room);

}  // namespace harness
