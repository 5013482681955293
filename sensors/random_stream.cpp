#include "sensors/random_stream.hpp"

namespace sensors {

namespace {

/// The FNV-1a hash of the bytes. std::hash may differ between libraries, and a stream must not.
std::uint64_t fnv1a(std::string_view bytes) {
  constexpr std::uint64_t offset_basis = 14695981039346656037U;
  constexpr std::uint64_t prime = 1099511628211U;
  std::uint64_t hash = offset_basis;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * prime;
  }
  return hash;
}

std::uint32_t low(std::uint64_t bits) { return static_cast<std::uint32_t>(bits & 0xffffffffU); }
std::uint32_t high(std::uint64_t bits) { return static_cast<std::uint32_t>(bits >> 32U); }

}  // namespace

std::mt19937_64 random_stream(std::uint64_t seed, std::string_view name) {
  const std::uint64_t hash = fnv1a(name);
  // seed_seq spreads nearby seeds over the engine's whole state; seeding with one word would not do so.
  std::seed_seq words{low(seed), high(seed), low(hash), high(hash)};
  return std::mt19937_64(words);
}

}  // namespace sensors
