#include "worlds/describe_parts.hpp"

#include <cmath>

#include "worlds/world.hpp"

namespace worlds {

void check_corners(Fields& fields, const Eigen::Vector2d& min, const Eigen::Vector2d& max) {
  if (fields.sound() && (min.array() >= max.array()).any()) {
    fields.problem("max_m", "'max_m' must be more than 'min_m' in x and in y");
  }
}

void describe_placement(Fields& fields, Placement& placement, Need need, double farthest) {
  fields.number("x_m", placement.position.x(), between(-farthest, farthest), "east", need);
  fields.number("y_m", placement.position.y(), between(-farthest, farthest), "north", need);
  fields.angle("heading_deg", placement.heading, between(-360, 360), "counter-clockwise from east");
  placement.heading = std::remainder(placement.heading, 360 * degree);
  if (placement.heading <= -180 * degree) placement.heading = 180 * degree;
}

}  // namespace worlds
