// The layers of a film by name, for world files and for the command line.
#pragma once

#include <array>
#include <string_view>

#include "worlds/world.hpp"

namespace worlds {

struct FilmLayer {
  std::string_view name;
  bool FilmLayers::*shown = nullptr;
  std::string_view help;
};

inline constexpr std::array<FilmLayer, 17> film_layers = {{
    {"grid", &FilmLayers::grid, "lines on the ground"},
    {"shadows", &FilmLayers::shadows, "shadows"},
    {"rays", &FilmLayers::rays, "rays of the latest scan, free and occluded"},
    {"range", &FilmLayers::range, "what the sensor covers"},
    {"truth", &FilmLayers::truth, "trail of the robot"},
    {"odometry", &FilmLayers::odometry, "trail of dead reckoning"},
    {"estimate", &FilmLayers::estimate, "trail and present pose of each estimator"},
    {"landmarks", &FilmLayers::landmarks, "estimates of landmarks"},
    {"ellipses", &FilmLayers::ellipses, "2-sigma ellipses of landmarks and robot"},
    {"errors", &FilmLayers::errors, "from each estimate to the truth"},
    {"active", &FilmLayers::active, "landmarks that have a link to the robot"},
    {"links", &FilmLayers::links, "links between landmarks"},
    {"matrix", &FilmLayers::matrix, "normalised information matrix, or covariance"},
    {"times", &FilmLayers::times, "chart of update times"},
    {"pose_error", &FilmLayers::pose_error, "chart of pose errors with their 3-sigma bands"},
    {"caption", &FilmLayers::caption, "what is filmed, and how fast"},
    {"legend", &FilmLayers::legend, "what the colours mean"},
}};
static_assert(sizeof(FilmLayers) == film_layers.size(), "each layer has a name");

}  // namespace worlds
