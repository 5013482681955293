// A hash that is the same on every machine and in every build, as std::hash is not.
#pragma once

#include <cstdint>
#include <string_view>

namespace harness {

/// 64 bits, by Fowler, Noll and Vo; RFC 9923 gives the constants.
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
