// The description of a drive.
#pragma once

#include <Eigen/Core>

#include "worlds/drive.hpp"
#include "worlds/fields.hpp"

namespace worlds {

/// A rectangle to be covered in lanes.
struct SerpentineArea {
  Eigen::Vector2d min = Eigen::Vector2d::Constant(-5);  // [m]
  Eigen::Vector2d max = Eigen::Vector2d::Constant(5);   // [m]
  double lane = 2.0;                                    // [m] between lanes, at most
};

/// Before the path is laid out and the command files are read.
void describe_drive(Fields& fields, Drive& drive, SerpentineArea& area);

}  // namespace worlds
