#include "allocation_counter.hpp"

#include <atomic>
#include <cstddef>

namespace {
std::atomic<long> count{0};
}

long allocations() { return count; }

// Eigen calls malloc and not operator new, so malloc itself is counted. glibc's own function is __libc_malloc.
#if COUNTS_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t size);  // NOLINT: glibc's name
extern "C" void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
#endif
