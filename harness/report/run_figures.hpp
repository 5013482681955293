// The figures of a run, from the files of its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "worlds/world.hpp"

namespace harness {

/// An estimator and the colour in which it is drawn.
struct Drawn {
  std::string name;
  Rgb colour = 0;
};

/// Map, errors, NEES and update times, except for those that the folder has no data for. The map shows what is
/// solid in `world`, if it is known. Throws BadInput if a file is missing or broken.
std::vector<Figure> run_figures(const std::filesystem::path& folder, const std::vector<Drawn>& estimators,
                                const worlds::World* world = nullptr);

/// The estimators with the colours of their types. Where two would have the same colour, they get others.
std::vector<Drawn> drawn(const std::vector<std::string>& names, const std::vector<std::string>& types);

}  // namespace harness
