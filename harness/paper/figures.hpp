// Figures 1, 2 and 6 of the report, drawn from our beliefs.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "harness/figures/gnuplot.hpp"
#include "harness/paper/belief.hpp"

namespace harness {

/// Map, correlations and normalised information side by side.
Picture figure_1(const Belief& ekf);

/// The normalised information of a sparse filter, and the network of its links.
Picture figure_2(const Belief& seif);

/// One row for each filter: map, links, correlations, normalised information.
Picture figure_6(std::span<const Belief> beliefs);

}  // namespace harness
