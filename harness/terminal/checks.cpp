#include "harness/terminal/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <system_error>

#include "worlds/suggestion.hpp"

namespace harness {

namespace {

/// The number that is written in the whole text.
template <class T>
std::optional<T> parse(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The beginning of what was written: nobody reads 300 digits.
std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 40;
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

std::string refusal(const std::string& text, const std::string& allowed) {
  return fmt::format("'{}' is not allowed: it must be {}", shortened(text), allowed);
}

CLI::Validator real_number(const std::string& allowed, const std::function<bool(double)>& is_allowed) {
  return {[=](const std::string& text) {
            const std::optional<double> value = parse<double>(text);
            if (value && std::isfinite(*value) && is_allowed(*value)) return std::string();
            return refusal(text, allowed);
          },
          ""};
}

}  // namespace

CLI::Validator whole_number(std::int64_t low, std::int64_t high) {
  const std::string allowed = high == std::numeric_limits<std::int64_t>::max() && low > 0
                                  ? fmt::format("a whole number, at least {}", low)
                                  : fmt::format("a whole number from {} to {}", low, high);
  return {[=](const std::string& text) {
            const std::optional<std::int64_t> value = parse<std::int64_t>(text);
            if (value && *value >= low && *value <= high) return std::string();
            return refusal(text, allowed);
          },
          ""};
}

CLI::Validator seed_number() { return whole_number(0, largest_seed); }

CLI::Validator any_finite_number() {
  return real_number("a finite number", [](double) { return true; });
}

CLI::Validator number_between(double low, double high) {
  return real_number(fmt::format("a number from {} to {}", low, high),
                     [=](double value) { return value >= low && value <= high; });
}

CLI::Validator positive_number(double high) {
  return real_number(fmt::format("a number more than 0 and at most {}", high),
                     [=](double value) { return value > 0.0 && value <= high; });
}

CLI::Validator one_of(const std::vector<std::string>& choices) {
  return {[=](const std::string& text) {
            if (std::ranges::find(choices, text) != choices.end()) return std::string();
            return refusal(text, fmt::format("one of {}", fmt::join(choices, ", "))) +
                   worlds::suggestion(text, choices);
          },
          fmt::format("{{{}}}", fmt::join(choices, ","))};
}

}  // namespace harness
