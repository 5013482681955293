// Finds places in a map whose landmarks have no names.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "seif/relocating/closing_search.hpp"
#include "seif/relocating/settled_constellations.hpp"
#include "seif/relocating/unnamed_search.hpp"

namespace seif {

struct PlaceFinder {
  /// `make_local` makes filters that name landmarks by themselves. `most_chance` [-]: of a wrong match that is as good
  /// as one that is taken.
  PlaceFinder(LocalBelief& belief, const LandmarkGrid& grid, LocalMap::MakeFilter make_local,
              const Pose2& T_robot_sensor, double most_chance)
      : map(grid),
        lost(belief, map, std::move(make_local), T_robot_sensor, std::log(most_chance)),
        closing(belief, map, std::log(most_chance)) {}

  SettledConstellations map;
  UnnamedSearch lost;     // of a robot that has lost its place
  ClosingSearch closing;  // of one that has come back without noticing it

  std::int64_t work() const { return map.work() + lost.work() + closing.work(); }
  std::size_t memory_bytes() const { return map.memory_bytes() + lost.memory_bytes(); }
};

}  // namespace seif
