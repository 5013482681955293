#include "seif/tree/homes.hpp"

#include <algorithm>
#include <cstddef>

namespace seif {

void Homes::finish(double far) {
  if (offsets_.empty()) return;
  for (int axis = 0; axis < 2; ++axis) {
    sorted_.clear();
    for (const Eigen::Vector2d& offset : offsets_) sorted_.push_back(offset(axis));
    const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
    std::nth_element(sorted_.begin(), middle, sorted_.end());
    offset_(axis) = *middle;
  }
  other_.reset();
  for (const Eigen::Vector2d& offset : offsets_) {
    if ((offset - offset_).norm() > far) other_ = offset;
  }
}

}  // namespace seif
