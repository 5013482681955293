// Text that is cut to the available width.
#pragma once

#include <string>

#include "sim/render/scene.hpp"

namespace harness {

/// The text if it is at most `room` [px] wide; otherwise its beginning and an ellipsis.
std::string fitted(std::string text, float size, render::Weight weight, float room);

}  // namespace harness
