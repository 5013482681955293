#include "sim/solids.hpp"

#include <cmath>
#include <stdexcept>

namespace sim {

namespace {

/// The shape of this size. It is made when first asked for.
template <class Shape, class Size>
Shape& shared(std::map<Size, std::unique_ptr<Shape>>& shapes, const Size& size,
              const btVector3& half_extents) {
  std::unique_ptr<Shape>& shape = shapes[size];
  if (!shape) {
    shape = std::make_unique<Shape>(half_extents);
  }
  return *shape;
}

/// Motion and sight are planar, whatever height is drawn: nothing passes over or under a solid. The height is
/// one metre, or more for a tall robot. The solids reach as far below the ground as above it.
double tall_enough(const worlds::Robot& robot) {
  return 1.0 + 4.0 * (robot.wheel_radius + robot.caster.radius);
}

}  // namespace

Solids::Solids(const worlds::World& world) : half_height_(tall_enough(world.robot)) {
  disks_.reserve(world.landmarks.size());
  shapes_.reserve(world.landmarks.size() + world.boxes.size());
  for (const worlds::Landmark& landmark : world.landmarks) {
    add_landmark(landmark);
  }
  for (const worlds::Box& box : world.boxes) {
    add_rectangle({box.centre.position, box.centre.heading, 0.5 * box.size});
  }
  for (const worlds::Wall& wall : world.walls) {
    add_wall(wall);
  }
  first_landmarks_ = landmarks();
  first_rectangles_ = static_cast<int>(rectangles_.size());
}

void Solids::add(const worlds::Landmark& landmark) {
  add_landmark(landmark);
  added_landmarks_.push_back(size() - 1);
  added_.push_back({true, landmarks() - 1});
}

void Solids::add(const worlds::Wall& wall) {
  const std::size_t rectangles = rectangles_.size();
  const std::size_t shapes = shapes_.size();
  try {
    add_wall(wall);
  } catch (const std::invalid_argument&) {
    rectangles_.resize(rectangles);
    shapes_.resize(shapes);
    throw;
  }
  for (std::size_t i = rectangles; i < rectangles_.size(); ++i)
    added_.push_back({false, static_cast<int>(i)});
}

const Solids::Added* Solids::added(int solid) const {
  const int first = first_landmarks_ + first_rectangles_;
  return solid < first ? nullptr : &added_[static_cast<std::size_t>(solid - first)];
}

bool Solids::is_landmark(int solid) const {
  const Added* later = added(solid);
  return later == nullptr ? solid < first_landmarks_ : later->is_landmark;
}

int Solids::landmark_of(int solid) const {
  const Added* later = added(solid);
  return later == nullptr ? solid : later->number;
}

int Solids::solid_of(int landmark) const {
  return landmark < first_landmarks_
             ? landmark
             : added_landmarks_[static_cast<std::size_t>(landmark - first_landmarks_)];
}

void Solids::remove_from(int solid) {
  while (size() > solid) {
    shapes_.pop_back();
    if (added_.back().is_landmark) {
      disks_.pop_back();
      added_landmarks_.pop_back();
    } else {
      rectangles_.pop_back();
    }
    added_.pop_back();
  }
}

void Solids::add_landmark(const worlds::Landmark& landmark) {
  const double radius = landmark.radius;
  if (!(radius > 0.0)) {
    throw std::invalid_argument("simulator: a landmark's radius must be positive");
  }
  disks_.push_back({landmark.position, radius});
  shapes_.push_back(&shared(cylinders_, {radius, 0.0}, btVector3(radius, radius, half_height_)));
}

void Solids::add_rectangle(const Rectangle& rectangle) {
  const Eigen::Vector2d& half = rectangle.half_size;
  if (!(half.x() > 0.0 && half.y() > 0.0)) {
    throw std::invalid_argument("simulator: the sizes of boxes and walls must be positive");
  }
  rectangles_.push_back(rectangle);
  shapes_.push_back(&shared(boxes_, {half.x(), half.y()}, btVector3(half.x(), half.y(), half_height_)));
}

/// Segments reach half a thickness beyond the points that they share. So corners are filled, and no ray passes
/// between two segments in line.
void Solids::add_wall(const worlds::Wall& wall) {
  const std::size_t points = wall.points.size();
  if (points < 2) {
    throw std::invalid_argument("simulator: a wall needs at least two points");
  }
  const std::size_t segments = wall.closed ? points : points - 1;
  const double half_thickness = 0.5 * wall.thickness;
  for (std::size_t i = 0; i < segments; ++i) {
    const Eigen::Vector2d& start = wall.points[i];
    const Eigen::Vector2d& end = wall.points[(i + 1) % points];
    const Eigen::Vector2d along = end - start;
    const double length = along.norm();
    const double before = wall.closed || i > 0 ? half_thickness : 0.0;
    const double after = wall.closed || i + 1 < segments ? half_thickness : 0.0;
    if (!(length > 0.0)) {
      throw std::invalid_argument("simulator: two points of a wall that follow each other must differ");
    }
    const Eigen::Vector2d middle = 0.5 * (start + end) + 0.5 * (after - before) / length * along;
    add_rectangle({middle, std::atan2(along.y(), along.x()),
                   Eigen::Vector2d(0.5 * (length + before + after), half_thickness)});
  }
}

double Solids::distance_to(int solid, const Segment& way) const {
  return is_landmark(solid) ? distance(way, disk(solid)) : distance(way, rectangle(solid));
}

btTransform Solids::T_world_solid(int solid) const {
  const double heading = is_landmark(solid) ? 0.0 : rectangle(solid).heading;
  const Eigen::Vector2d& centre = is_landmark(solid) ? disk(solid).centre : rectangle(solid).centre;
  return btTransform(btQuaternion(btVector3(0.0, 0.0, 1.0), heading), btVector3(centre.x(), centre.y(), 0.0));
}

const Rectangle& Solids::rectangle(int solid) const {
  const Added* later = added(solid);
  return rectangles_[static_cast<std::size_t>(later == nullptr ? solid - first_landmarks_ : later->number)];
}

}  // namespace sim
