// The problems of a world file as one exception.
#pragma once

#include <string>
#include <utility>

#include "harness/files/bad_input.hpp"
#include "worlds/load.hpp"

namespace seifbed {

/// The world. Throws BadInput with a line for each problem if it has any.
inline worlds::World sound_world(worlds::LoadResult loaded) {
  if (loaded.world) return std::move(*loaded.world);
  std::string text;
  for (const worlds::Problem& problem : loaded.problems) {
    if (!text.empty()) text += '\n';
    text += worlds::to_string(problem);
  }
  throw harness::BadInput(text);
}

}  // namespace seifbed
