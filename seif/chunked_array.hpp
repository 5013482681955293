// An array that grows without moving its elements. Adding an element costs the same at any size; a std::vector
// copies all elements now and then.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace seif {

template <class T>
class ChunkedArray {
 public:
  std::size_t size() const { return size_; }

  T& operator[](std::size_t i) {
    assert(i < size_);
    return chunks_[i / chunk_size][i % chunk_size];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return chunks_[i / chunk_size][i % chunk_size];
  }

  void push_back(T value) {
    if (size_ == chunks_.size() * chunk_size) chunks_.push_back(std::make_unique<T[]>(chunk_size));
    ++size_;
    (*this)[size_ - 1] = std::move(value);
  }

  std::size_t memory_bytes() const {
    return chunks_.size() * chunk_size * sizeof(T) + chunks_.capacity() * sizeof(chunks_[0]);
  }

 private:
  /// A power of two: some 32 kB.
  static constexpr std::size_t chunk_size =
      std::bit_floor(std::clamp<std::size_t>(32'768 / sizeof(T), 16, 1024));
  std::vector<std::unique_ptr<T[]>> chunks_;
  std::size_t size_ = 0;
};

}  // namespace seif
