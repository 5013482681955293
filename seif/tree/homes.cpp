#include "seif/tree/homes.hpp"

#include <limits>

namespace seif {

void Homes::finish(double far) {
  if (offsets_.empty()) return;
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& offset : offsets_) {
    double sum = 0.0;
    for (const Eigen::Vector2d& other : offsets_) sum += (other - offset).norm();
    if (sum >= least) continue;
    least = sum;
    offset_ = offset;
  }
  other_.reset();
  for (const Eigen::Vector2d& offset : offsets_) {
    if ((offset - offset_).norm() > far) other_ = offset;
  }
}

}  // namespace seif
