#include "harness/film/trail.hpp"

namespace harness {

namespace {

constexpr std::size_t most_fine = 512;     // [-] points; at least half as many are kept
constexpr std::size_t most_coarse = 1024;  // [-]

}  // namespace

void Trail::add(const Eigen::Vector2d& point) {
  if (!fine_.empty() && (point - fine_.back()).norm() < spacing_) return;
  fine_.push_back(point);
  if (fine_.size() > most_fine) retire();
}

/// Moves the older half of the fine points to the coarse ones.
void Trail::retire() {
  const auto end = fine_.begin() + most_fine / 2;
  for (auto it = fine_.begin(); it != end; ++it) {
    if (!coarse_.empty() && (*it - coarse_.back()).norm() < coarse_spacing_) continue;
    coarse_.push_back(*it);
    if (coarse_.size() > most_coarse) thin_out();
  }
  fine_.erase(fine_.begin(), end);
}

void Trail::thin_out() {
  coarse_spacing_ *= 2.0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < coarse_.size(); i += 2) coarse_[kept++] = coarse_[i];
  coarse_.resize(kept);
}

}  // namespace harness
