// Reduces the number of points of long curves, so that the page of an hour's run opens fast.
#pragma once

#include <cstddef>
#include <vector>

namespace harness {

struct Points {
  std::vector<double> x;
  std::vector<double> y;  // same length as x
};

/// Divides the range of x into `bins` equal bins and keeps the smallest and the largest y of each, in their
/// order, so that no peak is lost. Points with up to twice as many values are returned unchanged. x is
/// ascending or equal, and all values are finite.
Points smallest_and_largest(Points points, std::size_t bins);

/// At most `most` (two or more) of the points, spread evenly, with the first and the last.
Points thinned(Points points, std::size_t most);

}  // namespace harness
