#include "worlds/fields.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

#include "worlds/world.hpp"

namespace worlds {
namespace {

/// The shortest number of degrees that is read back as exactly these radians, if there is one.
double to_degrees(double radians) {
  constexpr int most_digits = 17;  // enough to distinguish all doubles
  for (int digits = 1; digits <= most_digits; ++digits) {
    const std::string text = fmt::format("{:.{}g}", radians / degree, digits);
    double degrees = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), degrees);
    if (degrees * degree == radians) return degrees;
  }
  return radians / degree;
}

}  // namespace

void Fields::number(std::string_view key, double& value, const Range& range, std::string_view help,
                    Need need) {
  field({.key = key, .help = help, .need = need, .range = range}, &value);
}

void Fields::angle(std::string_view key, double& radians, const Range& range_deg, std::string_view help,
                   Need need) {
  double degrees = to_degrees(radians);
  field({.key = key, .help = help, .need = need, .range = range_deg}, &degrees);
  radians = degrees * degree;
}

void Fields::boolean(std::string_view key, bool& value, std::string_view help, Need need) {
  field({.key = key, .help = help, .need = need}, &value);
}

void Fields::text(std::string_view key, std::string& value, std::string_view help, Need need) {
  field({.key = key, .help = help, .need = need}, &value);
}

void Fields::choice(std::string_view key, std::string& value, const std::vector<std::string>& choices,
                    std::string_view help, Need need) {
  field({.key = key, .help = help, .need = need, .choices = choices}, &value);
}

void Fields::vector2(std::string_view key, Eigen::Vector2d& value, const Range& range, std::string_view help,
                     Need need) {
  field({.key = key, .help = help, .need = need, .range = range}, &value);
}

void Fields::vector3(std::string_view key, Eigen::Vector3d& value, const Range& range, std::string_view help,
                     Need need) {
  field({.key = key, .help = help, .need = need, .range = range}, &value);
}

void Fields::points(std::string_view key, std::vector<Eigen::Vector2d>& value, const Range& range,
                    std::size_t min_count, std::string_view help, Need need) {
  field({.key = key, .help = help, .need = need, .range = range, .min_count = min_count}, &value);
}

void Fields::names(std::string_view key, std::vector<std::string>& value, std::size_t max_count,
                   std::string_view help, Need need) {
  field({.key = key, .help = help, .need = need, .max_count = max_count}, &value);
}

std::string_view unit_of_key(std::string_view key) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 18> units = {{
      {"_per_m2", "per m^2"},  // longer endings come first
      {"_deg_s2", "deg/s^2"},
      {"_bytes_s", "byte/s"},
      {"_deg_s", "deg/s"},
      {"_m_s2", "m/s^2"},
      {"_per_m", "per m"},
      {"_m_s", "m/s"},
      {"_rad_s", "rad/s"},
      {"_deg", "deg"},
      {"_rad", "rad"},
      {"_sigma", "sigma"},
      {"_kg", "kg"},
      {"_hz", "Hz"},
      {"_nm", "N m"},
      {"_px", "px"},
      {"_m", "m"},
      {"_s", "s"},
      {"_w", "W"},
  }};
  for (const auto& [ending, unit] : units) {
    if (key.ends_with(ending)) return unit;
  }
  return "";
}

std::string show_bound(double bound) {
  if (bound >= beyond_integers) return fmt::format("{}", std::numeric_limits<std::int64_t>::max());
  return fmt::format("{}", bound);
}

}  // namespace worlds
