// A filter's matrix as a picture: dark cells are strong links between robot and landmarks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "harness/film/point_index.hpp"
#include "seif/estimator.hpp"
#include "sim/render/scene.hpp"

namespace harness {

/// The robot first, then the landmarks in the order in which they joined the map. Where there are more of
/// them than cells, a cell shows the strongest block in it.
class MatrixPicture {
 public:
  /// Reads the whole matrix. `map` tells the order of the landmarks.
  void read(const seif::Estimator& filter, const PointIndex& map);

  /// Blocks that are not zero, of all that there are. [-]
  double fill() const { return fill_; }
  seif::BeliefMatrix matrix() const { return matrix_; }
  bool empty() const { return cells_.empty(); }

  int size() const { return size_; }                          // [-] cells along an edge
  const std::vector<float>& cells() const { return cells_; }  // (size x size) strengths [-]
  /// The darkness of a cell of this strength. [-] in [0, 1]
  static float darkness(float strength);

  render::Raster raster(const Eigen::Vector2f& min, const Eigen::Vector2f& max) const;

 private:
  seif::BeliefMatrix matrix_ = seif::BeliefMatrix::none;
  int size_ = 0;              // [-] cells along an edge
  std::vector<float> cells_;  // (size x size) strengths [-]
  double fill_ = 0.0;
  std::vector<seif::Coupling> couplings_;  // reused
  std::unordered_map<seif::LandmarkId, std::size_t> numbers_;
};

}  // namespace harness
