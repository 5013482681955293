// The text over the views of a frame: caption, names, legend, matrix.
#pragma once

#include <string>
#include <vector>

#include "harness/film/belief_view.hpp"
#include "harness/film/layout.hpp"
#include "sim/render/scene.hpp"

namespace harness {

struct Caption {
  std::string name;         // of the world or log
  std::string description;  // one sentence, or empty
  std::string facts;        // of the moment
};

void append_caption(const Frame& frame, float scale, const Caption& caption,
                    std::vector<render::OverlayItem>& overlay);

/// Name and figures of the estimator whose view this is.
void append_view_title(const Frame& frame, float scale, const BeliefView& belief,
                       std::vector<render::OverlayItem>& overlay);

/// The matrix of an estimator.
void append_matrix(const Frame& frame, float scale, const BeliefView& belief,
                   std::vector<render::OverlayItem>& overlay);

/// The legend of the marks.
void append_legend(const Frame& frame, float scale, const worlds::FilmLayers& layers,
                   const std::vector<BeliefView>& beliefs, bool has_truth,
                   std::vector<render::OverlayItem>& overlay);

/// White, with hairlines between the parts.
void append_panel(const Layout& layout, std::vector<render::OverlayItem>& overlay);

}  // namespace harness
