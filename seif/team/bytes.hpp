// Numbers as bytes, the lowest first.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seif {

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <std::unsigned_integral Number>
  void put(Number number) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      bytes_.push_back(static_cast<std::byte>(number >> (8U * i) & 0xFFU));
  }
  void put(float number) { put(std::bit_cast<std::uint32_t>(number)); }
  void put(double number) { put(std::bit_cast<std::uint64_t>(number)); }
  void put(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }

 private:
  std::vector<std::byte>& bytes_;
};

/// After the end of the bytes it reads zeros, and is not whole any more.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <std::unsigned_integral Number>
  Number get() {
    Number number = 0;
    if (bytes_.size() < sizeof(Number)) {
      whole_ = false;
      bytes_ = {};
      return number;
    }
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      number =
          static_cast<Number>(number | static_cast<Number>(std::to_integer<Number>(bytes_[i]) << (8U * i)));
    bytes_ = bytes_.subspan(sizeof(Number));
    return number;
  }
  float get_float() { return std::bit_cast<float>(get<std::uint32_t>()); }
  double get_double() { return std::bit_cast<double>(get<std::uint64_t>()); }

  std::span<const std::byte> rest() const { return bytes_; }
  bool is_whole() const { return whole_; }
  bool is_at_end() const { return whole_ && bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
  bool whole_ = true;
};

}  // namespace seif
