// Text that keeps to the room that there is.
#pragma once

#include <string>

#include "sim/render/scene.hpp"

namespace harness {

/// The text, or as much of it as is no wider than `room` [px], with an ellipsis.
std::string fitted(std::string text, float size, render::Weight weight, float room);

}  // namespace harness
