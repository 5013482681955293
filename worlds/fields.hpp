// A document is described once. From the description come a strict reader, which fills in the defaults, and a
// schema.
//
//   void describe(Fields& fields, Caster& caster) {
//     fields.number("offset_m", caster.offset, any_number(), "along the robot's x from the axle");
//     fields.number("radius_m", caster.radius, more_than(0), "radius");
//   }
//
// A description must ask for the same fields whatever the values are: the reader and the writer of the schema
// both run it. The value of a variable before the call is the default of its field. The end of a key tells the
// unit of a number (`_m`, `_deg_s`).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "worlds/document.hpp"
#include "worlds/field_spec.hpp"

namespace worlds {

/// See the head of the file. Functions that take `describe` call it with the fields of the inner map.
class Fields {
 public:
  /// One of several kinds of section. The keys of all other kinds are asked for before the chosen kind is read,
  /// so a description must write only to the values that it describes.
  struct Case {
    std::string name;
    std::string help;
    std::function<void(Fields&)> describe;  // the keys that only this kind has
  };

  virtual ~Fields() = default;

  /// A finite number; integers are numbers.
  void number(std::string_view key, double& value, const Range& range, std::string_view help,
              Need need = Need::defaulted);

  /// A number in degrees (or degrees per ...), stored in radians. `range` is in degrees.
  void angle(std::string_view key, double& radians, const Range& range_deg, std::string_view help,
             Need need = Need::defaulted);

  /// A number without a fraction.
  template <std::integral T>
  void integer(std::string_view key, T& value, const Range& range, std::string_view help,
               Need need = Need::defaulted) {
    constexpr auto lowest = static_cast<double>(std::numeric_limits<T>::min());
    constexpr auto highest = static_cast<double>(std::numeric_limits<T>::max());
    auto wide = static_cast<std::int64_t>(value);
    field({.key = key,
           .help = help,
           .need = need,
           .range = {.min = std::max(range.min, lowest),
                     .max = std::min({range.max, highest, beyond_integers})}},
          &wide);
    value = static_cast<T>(wide);
  }

  void boolean(std::string_view key, bool& value, std::string_view help, Need need = Need::defaulted);

  void text(std::string_view key, std::string& value, std::string_view help, Need need = Need::defaulted);

  /// A text that is one of `choices`.
  void choice(std::string_view key, std::string& value, const std::vector<std::string>& choices,
              std::string_view help, Need need = Need::defaulted);

  /// [x, y], both in the range.
  void vector2(std::string_view key, Eigen::Vector2d& value, const Range& range, std::string_view help,
               Need need = Need::defaulted);

  /// [x, y, z], all in the range.
  void vector3(std::string_view key, Eigen::Vector3d& value, const Range& range, std::string_view help,
               Need need = Need::defaulted);

  /// [[x, y], ...], at least `min_count` points, all numbers in the range.
  void points(std::string_view key, std::vector<Eigen::Vector2d>& value, const Range& range,
              std::size_t min_count, std::string_view help, Need need = Need::defaulted);

  /// [name, ...], at most `max_count` different names.
  void names(std::string_view key, std::vector<std::string>& value, std::size_t max_count,
             std::string_view help, Need need = Need::defaulted);

  /// An inner map. A missing one is read as an empty map, so its required keys are problems.
  virtual void section(std::string_view key, std::string_view help,
                       const std::function<void(Fields&)>& describe) = 0;

  /// A list of maps, each described by describe(fields, item). A missing list is empty.
  template <class T, class Describe>
  void list(std::string_view key, std::vector<T>& items, const Describe& describe, std::string_view help) {
    list_of_maps(
        key, help, [&](std::size_t count) { items.resize(count); },
        [&](Fields& fields, std::size_t index) { describe(fields, items[index]); });
  }

  /// A map from names to maps, in the order of the document. A missing one is empty.
  virtual void named(std::string_view key, const NameRule& rule, std::string_view help,
                     const std::function<void(Fields&, const std::string& name)>& describe) = 0;

  /// The kind of this section, and the keys of that kind. A key of another kind is a problem, and its message
  /// says so. With Need::required there is no default kind.
  virtual void variant(std::string_view key, std::string& kind, const std::vector<Case>& cases,
                       std::string_view help, Need need = Need::defaulted) = 0;

  /// Whether everything described so far was read without a problem. Only then can values be checked against
  /// each other.
  virtual bool sound() const = 0;

  /// Adds a problem with the value of a key (empty: with the whole section). Only the reader uses it.
  virtual void problem(std::string_view key, std::string message) = 0;

  /// Keys that nobody describes are no problem in this section. Only the reader uses it.
  virtual void accept_unknown_keys() {}

 protected:
  using Value = std::variant<bool*, std::int64_t*, double*, std::string*, Eigen::Vector2d*, Eigen::Vector3d*,
                             std::vector<Eigen::Vector2d>*, std::vector<std::string>*>;

  virtual void field(const FieldSpec& spec, Value value) = 0;
  virtual void list_of_maps(std::string_view key, std::string_view help,
                            const std::function<void(std::size_t)>& resize,
                            const std::function<void(Fields&, std::size_t)>& describe) = 0;
};

/// Reads a document as described. Adds everything that is wrong to `problems`, and writes the defaults of
/// missing keys into the document. True if there was no problem. Values with a problem keep their defaults.
bool read_fields(Node& document, const std::function<void(Fields&)>& describe,
                 std::vector<Problem>& problems);

/// The unit that the end of a key tells, as in "m/s"; empty if the key tells no unit.
std::string_view unit_of_key(std::string_view key);

/// A bound of a range, in words.
std::string show_bound(double bound);

}  // namespace worlds
