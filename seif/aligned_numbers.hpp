// Numbers in memory that begins where Eigen's packets begin.
//
// Eigen sums up in another order where a vector begins between two packets. So the last bits of a result would depend
// on where the heap happens to put a vector, and with that on everything else that the program does.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace seif {

using AlignedNumbers = std::vector<double, Eigen::aligned_allocator<double>>;

struct AlignedDelete {
  static constexpr std::align_val_t alignment{64};  // [byte] a cache line; no packet is longer
  void operator()(double* numbers) const { ::operator delete[](numbers, alignment); }
};

/// An array that does not change its size.
using AlignedArray = std::unique_ptr<double[], AlignedDelete>;

/// The values are undefined.
inline AlignedArray make_aligned_array(std::size_t size) {
  return AlignedArray(
      static_cast<double*>(::operator new[](size * sizeof(double), AlignedDelete::alignment)));
}

}  // namespace seif
