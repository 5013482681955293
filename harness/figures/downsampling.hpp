// Long curves with fewer points, so that a page of an hour's run opens fast.
#pragma once

#include <cstddef>
#include <vector>

namespace harness {

struct Points {
  std::vector<double> x;
  std::vector<double> y;  // as many
};

/// Of each of `bins` equal stretches of x, which never falls, the smallest and the largest value of y, in the
/// order in which they came: nothing that sticks out is lost. As it is if it has no more than twice as many
/// points. All values finite.
Points smallest_and_largest(Points points, std::size_t bins);

/// At most `most` (two or more) of the points, evenly spread, the first and the last among them.
Points thinned(Points points, std::size_t most);

}  // namespace harness
