// Long curves with fewer points, so that a page of an hour's run opens fast.
#pragma once

#include <cstddef>
#include <vector>

namespace harness {

struct Points {
  std::vector<double> x;
  std::vector<double> y;  // as many
};

/// Keeps the smallest and the largest y of each of `bins` equal intervals of x, in their order, so that no peak is
/// lost. A curve of at most 2 `bins` points stays unchanged. x never falls, and all values are finite.
Points smallest_and_largest(Points points, std::size_t bins);

/// At most `most` (two or more) of the points, evenly spread, the first and the last among them.
Points thinned(Points points, std::size_t most);

}  // namespace harness
