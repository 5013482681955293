// What the descriptions of several sections share.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "worlds/fault.hpp"
#include "worlds/fields.hpp"
#include "worlds/robot.hpp"
#include "worlds/solids.hpp"

namespace worlds {

inline constexpr double longest_duration = 1e6;   // [s]
inline constexpr double largest_ground = 1e5;     // [m]
inline constexpr double largest_clearance = 1e3;  // [m]
inline constexpr double highest_speed = 10;       // [m/s]
inline constexpr double highest_step_rate = 1e4;  // [Hz]
inline constexpr double smallest_length = 1e-6;   // [m] of what divides or is squared

/// The enumerator whose name is `name`; names[i] is the name of enumerator i. An unknown name gives the first
/// enumerator: the reader has reported it as a problem.
template <class Enum, std::size_t N>
Enum enum_of(const std::array<std::string_view, N>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? Enum{} : static_cast<Enum>(found - names.begin());
}

template <class Enum, std::size_t N>
std::string name_of(const std::array<std::string_view, N>& names, Enum value) {
  return std::string(names.at(static_cast<std::size_t>(value)));
}

/// A choice among the enumerators, by their names.
template <class Enum, std::size_t N>
void describe_choice(Fields& fields, std::string_view key, Enum& value,
                     const std::array<std::string_view, N>& names, std::string_view help,
                     Need need = Need::defaulted) {
  std::string name = name_of(names, value);
  fields.choice(key, name, {names.begin(), names.end()}, help, need);
  value = enum_of<Enum>(names, name);
}

/// The range of a coordinate.
inline Range coordinate() { return between(-largest_ground, largest_ground); }

/// Adds a problem unless the rectangle has an inside.
void check_corners(Fields& fields, const Eigen::Vector2d& min, const Eigen::Vector2d& max);

void describe_landmark(Fields& fields, Landmark& landmark);
void describe_patch(Fields& fields, FrictionPatch& patch);
void describe_wall(Fields& fields, Wall& wall);

/// `farthest` [m]: the largest coordinate, in x and in y.
void describe_placement(Fields& fields, Placement& placement, Need need, double farthest = largest_ground);

}  // namespace worlds
