// Independent random streams, one for each (seed, name). Drawing from one stream does not change another.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace sensors {

/// The random engine of the stream `name` in the run `seed`. Equal arguments give equal engines, on every
/// machine.
std::mt19937_64 random_stream(std::uint64_t seed, std::string_view name);

}  // namespace sensors
