#include "seif/estimator.hpp"

#include <algorithm>

namespace seif {

void Estimator::landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const {
  out.clear();
  if (landmarks.empty()) return;
  std::vector<LandmarkEstimate> sorted = map();
  std::ranges::sort(sorted, {}, &LandmarkEstimate::landmark);
  for (const LandmarkId landmark : landmarks) {
    const auto found = std::ranges::lower_bound(sorted, landmark, {}, &LandmarkEstimate::landmark);
    if (found != sorted.end() && found->landmark == landmark) out.push_back(*found);
  }
}

}  // namespace seif
