// Counts the allocations of this program.
#pragma once

#include <cstddef>  // defines __GLIBC__

// The address and thread sanitizers have their own malloc.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define COUNTS_ALLOCATIONS 0
#else
#define COUNTS_ALLOCATIONS 1
#endif

/// Calls of malloc so far; always 0 where COUNTS_ALLOCATIONS is 0.
long allocations();
