// The legend of a film, which explains its marks.
#pragma once

#include <string>
#include <vector>

#include "harness/figures/palette.hpp"
#include "harness/film/chart.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/stream/log_description.hpp"
#include "sim/render/scene.hpp"
#include "worlds/world.hpp"

namespace harness {

struct LegendEntry {
  enum class Mark { line, dashes, band, disk, ring, sector, post, box };
  Mark mark = Mark::line;
  Rgb colour = 0;
  float size = 2.0F;  // width of a line, radius of a disk [px]
  std::string words;
};

/// An estimator that is filmed, as the legend names it.
struct Shown {
  std::string name;
  Rgb colour = 0;
  bool has_links = false;  // its matrix is an information matrix
};

/// What the log and the world of a film hold.
struct LegendFacts {
  bool has_truth = false;           // the robot's true path
  bool has_true_landmarks = false;  //
  bool knows_world = false;         // what follows is then known
  bool has_obstacles = false;       // walls or boxes
  bool has_patches = false;         // ground with a friction of its own
  bool has_hidden = false;          // something can hide a landmark
  bool has_false_detections = false;
};

LegendFacts legend_facts(const worlds::World& world, bool knows_world, const LogDescription& log);

/// An entry for each kind of mark that a film may draw, and for no other.
std::vector<LegendEntry> legend_entries(const worlds::FilmLayers& layers, const LegendFacts& facts,
                                        const std::vector<Shown>& shown);

/// Appends the entries in two columns.
void append_legend(const Frame& frame, float scale, const std::vector<LegendEntry>& entries,
                   std::vector<render::OverlayItem>& overlay);

}  // namespace harness
