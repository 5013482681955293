// The flat overlay on top of an image. All lengths are in pixels of the image as it is written. Pixels count
// from its upper left corner, x to the right, y down.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "sim/render/colour.hpp"

namespace render {

struct Rectangle {
  Eigen::Vector2f min = Eigen::Vector2f::Zero();
  Eigen::Vector2f max = Eigen::Vector2f::Zero();
  Colour colour;
};

enum class Align { left, centre, right };
enum class Weight { regular, bold };

/// One line of UTF-8 text. A character that the font does not have is drawn as a box.
struct Text {
  Eigen::Vector2f position = Eigen::Vector2f::Zero();  // the start, centre or end of the baseline
  float size = 14.0F;                                  // size of the em
  Align align = Align::left;
  Weight weight = Weight::regular;
  Colour colour;
  std::string text;
};

struct Polyline {
  std::vector<Eigen::Vector2f> points;
  float width = 1.5F;
  Colour colour;
};

/// The area between two curves over the same x.
struct Band {
  std::vector<Eigen::Vector3f> points;  // x, y of the first curve, y of the second
  Colour colour;
};

/// A picture of square cells with sharp edges.
struct Raster {
  Eigen::Vector2f min = Eigen::Vector2f::Zero();
  Eigen::Vector2f max = Eigen::Vector2f::Zero();
  int columns = 0;                 // [-]
  int rows = 0;                    // [-]
  std::vector<std::uint8_t> rgba;  // (rows x columns x 4), rows from the top
};

using OverlayItem = std::variant<Rectangle, Text, Polyline, Band, Raster>;

}  // namespace render
