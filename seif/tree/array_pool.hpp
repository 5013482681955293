// Arrays of numbers that pass from owner to owner and return to their pool. A user that needs arrays of changing
// sizes again and again allocates nothing, once the pool has grown to the largest need.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "seif/aligned_numbers.hpp"

namespace seif {

class ArrayPool {
 public:
  /// Returns to its pool on destruction; the pool must live longer.
  class Array {
   public:
    Array() = default;
    Array(Array&& other) noexcept
        : pool_(other.pool_),
          memory_(std::move(other.memory_)),
          shelf_(other.shelf_),
          size_(std::exchange(other.size_, 0)) {}
    Array& operator=(Array&& other) noexcept {
      clear();
      pool_ = other.pool_;
      memory_ = std::move(other.memory_);
      shelf_ = other.shelf_;
      size_ = std::exchange(other.size_, 0);
      return *this;
    }
    ~Array() { clear(); }

    void clear() {
      if (memory_) pool_->take_back(std::move(memory_), shelf_);
      size_ = 0;
    }
    double* data() { return memory_.get(); }
    const double* data() const { return memory_.get(); }
    std::size_t size() const { return size_; }
    double operator[](std::size_t i) const {
      assert(i < size_);
      return memory_[i];
    }

   private:
    friend class ArrayPool;
    Array(ArrayPool* pool, AlignedArray memory, std::size_t shelf, std::size_t size)
        : pool_(pool), memory_(std::move(memory)), shelf_(shelf), size_(size) {}

    ArrayPool* pool_ = nullptr;
    AlignedArray memory_;
    std::size_t shelf_ = 0;  // that it returns to
    std::size_t size_ = 0;
  };

  ArrayPool() = default;
  ArrayPool(const ArrayPool&) = delete;
  ArrayPool& operator=(const ArrayPool&) = delete;

  /// The values are undefined. An array that lies free is taken if it is not much larger than twice the size.
  Array take(std::size_t size) {
    constexpr std::size_t shelves_to_double = 4;
    if (size == 0) return {};
    const std::size_t smallest = shelf_of(size);
    const std::size_t end = std::min(smallest + shelves_to_double + 1, shelves);
    for (std::size_t shelf = smallest; shelf < end; ++shelf) {
      auto& free = shelves_[shelf].free;
      if (free.empty()) continue;
      AlignedArray memory = std::move(free.back());
      free.pop_back();
      return {this, std::move(memory), shelf, size};
    }
    return {this, made(shelves_.at(smallest), capacity_of(size)), smallest, size};
  }

  /// The memory of all arrays, in use or not.
  std::size_t memory_bytes() const { return bytes_; }

 private:
  /// Arrays of one capacity. The capacity grows by a seventh to a quarter from shelf to shelf.
  struct Shelf {
    std::vector<AlignedArray> free;
    std::size_t made = 0;
  };
  static constexpr std::size_t shelves = 128;

  static int shift_of(std::size_t size) {
    return std::max(0, static_cast<int>(std::bit_width(size - 1)) - 3);
  }
  static std::size_t capacity_of(std::size_t size) {
    const int shift = shift_of(size);
    return (((size - 1) >> shift) + 1) << shift;
  }
  static std::size_t shelf_of(std::size_t size) {
    const int shift = shift_of(size);
    return 4 * static_cast<std::size_t>(shift) + ((size - 1) >> shift);
  }

  AlignedArray made(Shelf& shelf, std::size_t capacity) {
    ++shelf.made;
    if (shelf.made > shelf.free.capacity()) shelf.free.reserve(2 * shelf.made);  // for all to come back
    bytes_ += capacity * sizeof(double);
    return make_aligned_array(capacity);
  }
  void take_back(AlignedArray memory, std::size_t shelf) noexcept {
    shelves_[shelf].free.push_back(std::move(memory));
  }

  std::array<Shelf, shelves> shelves_;
  std::size_t bytes_ = 0;
};

}  // namespace seif
