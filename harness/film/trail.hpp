// The path of a moving point, in bounded memory: the whole path coarsely, its last part finely.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace harness {

/// Distance between the points of a trail. [m]
inline constexpr double trail_spacing = 0.05;

class Trail {
 public:
  /// A point is left out if it is nearer than `spacing` [m] to the one before.
  explicit Trail(double spacing) : spacing_(spacing), coarse_spacing_(spacing) {}

  void add(const Eigen::Vector2d& point);

  /// Calls visit(from, to) for each leg, the oldest first. The last leg leads to `head`.
  template <class Visit>
  void for_each_leg(const Eigen::Vector2d& head, const Visit& visit) const {
    const Eigen::Vector2d* last = nullptr;
    for (const std::vector<Eigen::Vector2d>* part : {&coarse_, &fine_}) {
      for (const Eigen::Vector2d& point : *part) {
        if (last != nullptr) visit(*last, point);
        last = &point;
      }
    }
    if (last != nullptr) visit(*last, head);
  }

  std::size_t points() const { return coarse_.size() + fine_.size(); }

 private:
  void retire();
  void thin_out();

  double spacing_;                       // [m]
  double coarse_spacing_;                // [m]
  std::vector<Eigen::Vector2d> coarse_;  // the older part
  std::vector<Eigen::Vector2d> fine_;
};

}  // namespace harness
