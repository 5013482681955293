#include "worlds/limits.hpp"

#include <stdexcept>

namespace worlds {
namespace {

Limits& present_limits() {
  static Limits present;
  return present;
}

}  // namespace

const Limits& limits() { return present_limits(); }

void raise_limits(double factor) {
  if (!(factor >= 1.0 && factor <= 100.0)) throw std::invalid_argument("limits are raised by 1 to 100");
  const auto raised = [factor](auto limit) {
    return static_cast<decltype(limit)>(factor * static_cast<double>(limit));
  };
  const Limits usual;
  present_limits() = {raised(usual.bytes), raised(usual.values), raised(usual.landmarks),
                      raised(usual.fruitless_tries)};
}

void set_limits(const Limits& limits) { present_limits() = limits; }

}  // namespace worlds
