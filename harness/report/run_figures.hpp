// The figures of a run, from the files of its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/figures/figure.hpp"

namespace harness {

/// An estimator and how it is drawn.
struct Drawn {
  std::string name;
  Rgb colour = 0;
};

/// Map, errors, NEES and update times, as far as the folder has them. Throws BadInput if a
/// file is missing or broken.
std::vector<Figure> run_figures(const std::filesystem::path& folder, const std::vector<Drawn>& estimators);

/// The estimators with the colours of their types, or with others where two have the same.
std::vector<Drawn> drawn(const std::vector<std::string>& names, const std::vector<std::string>& types);

}  // namespace harness
