#include "harness/film/matrix_picture.hpp"

#include <algorithm>
#include <cmath>

namespace harness {

namespace {

constexpr std::size_t most_cells = 128;  // [-] along an edge: about one for each pixel

std::array<std::uint8_t, 3> shade(float dark) {
  const auto channel = [&](float full) {
    return static_cast<std::uint8_t>(std::lround(255.0F * (1.0F - dark * (1.0F - full))));
  };
  return {channel(0.06F), channel(0.10F), channel(0.16F)};
}

}  // namespace

void MatrixPicture::read(const seif::Estimator& filter, const PointIndex& map) {
  matrix_ = filter.belief_matrix();
  cells_.clear();
  if (matrix_ == seif::BeliefMatrix::none) return;
  for (std::size_t i = numbers_.size(); i < map.size(); ++i) numbers_.emplace(map.id(i), i + 1);
  const std::size_t rows = map.size() + 1;
  const std::size_t size = std::min(rows, most_cells);
  size_ = static_cast<int>(size);
  cells_.assign(size * size, 0.0F);
  const auto cell = [&](std::size_t row) { return row * size / rows; };
  std::size_t blocks = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    float* const line = &cells_[cell(i) * size];
    line[cell(i)] = 1.0F;
    filter.couplings(i == 0 ? seif::no_landmark : map.id(i - 1), couplings_);
    blocks += couplings_.size() + 1;
    for (const seif::Coupling& coupling : couplings_) {
      const auto other = numbers_.find(coupling.other);
      if (other == numbers_.end() && coupling.other != seif::no_landmark) continue;  // unknown to the film
      const std::size_t j = other == numbers_.end() ? 0 : other->second;
      line[cell(j)] = std::max(line[cell(j)], static_cast<float>(coupling.strength));
    }
  }
  fill_ = static_cast<double>(blocks) / (static_cast<double>(rows) * static_cast<double>(rows));
}

/// A block that is not zero is never white, because it matters which blocks are zero. Strengths of
/// information differ by orders of magnitude, so their scale is a fourth root. Correlations crowd below 1, so
/// their scale is the logarithm of what they lack: each further nine is a quarter darker.
float MatrixPicture::darkness(seif::BeliefMatrix matrix, float strength) {
  constexpr float blackest = 0.9999F;  // [-] correlation
  if (strength <= 0.0F) return 0.0F;
  if (matrix == seif::BeliefMatrix::information) return 0.12F + 0.88F * std::sqrt(std::sqrt(strength));
  const float share = std::log(1.0F - std::min(strength, blackest)) / std::log(1.0F - blackest);
  return 0.06F + 0.94F * share;
}

std::array<float, 3> MatrixPicture::ticks(seif::BeliefMatrix matrix) {
  if (matrix == seif::BeliefMatrix::information) return {0.01F, 0.1F, 1.0F};
  return {0.9F, 0.99F, 0.999F};
}

render::Raster MatrixPicture::raster(const Eigen::Vector2f& min, const Eigen::Vector2f& max) const {
  render::Raster raster;
  raster.min = min;
  raster.max = max;
  raster.columns = size_;
  raster.rows = size_;
  raster.rgba.reserve(4 * cells_.size());
  for (const float strength : cells_) {
    const float dark = darkness(matrix_, strength);
    for (const std::uint8_t channel : shade(dark)) raster.rgba.push_back(channel);
    raster.rgba.push_back(255);
  }
  return raster;
}

render::Raster MatrixPicture::scale(const Eigen::Vector2f& min, const Eigen::Vector2f& max) {
  constexpr int steps = 64;
  render::Raster raster;
  raster.min = min;
  raster.max = max;
  raster.columns = steps;
  raster.rows = 1;
  for (int i = 0; i < steps; ++i) {
    for (const std::uint8_t channel : shade(static_cast<float>(i) / (steps - 1)))
      raster.rgba.push_back(channel);
    raster.rgba.push_back(255);
  }
  return raster;
}

}  // namespace harness
