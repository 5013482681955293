// A hash that is the same on every machine and in every build, unlike std::hash.
#pragma once

#include <cstdint>
#include <string_view>

namespace harness {

/// The 64-bit hash of Fowler, Noll and Vo; the constants are in RFC 9923.
class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      hash_ ^= static_cast<unsigned char>(byte);
      hash_ *= 0x100000001b3U;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace harness
