// The text over the views of a frame, and the panel: caption, names, matrices.
#pragma once

#include <string>
#include <vector>

#include "harness/film/belief_view.hpp"
#include "harness/film/layout.hpp"
#include "sim/render/scene.hpp"

namespace harness {

struct Caption {
  std::string name;         // name of the world or log
  std::string description;  // one sentence, or empty
  std::string facts;        // about the moment, for instance the time
};

void append_caption(const Frame& frame, float scale, const Caption& caption,
                    std::vector<render::OverlayItem>& overlay);

/// Appends the name and the figures of the view's estimator.
void append_view_title(const Frame& frame, float scale, const BeliefView& belief,
                       std::vector<render::OverlayItem>& overlay);

/// Appends the picture of an estimator's matrix.
void append_matrix(const Frame& frame, float scale, const BeliefView& belief,
                   std::vector<render::OverlayItem>& overlay);

/// Appends the panel's white background, with thin lines between the parts.
void append_panel(const Layout& layout, std::vector<render::OverlayItem>& overlay);

}  // namespace harness
