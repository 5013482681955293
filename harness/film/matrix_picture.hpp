// A picture of the matrix that a filter keeps: a dark cell is a strong link between robot or landmarks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "harness/film/point_index.hpp"
#include "seif/estimator.hpp"
#include "sim/render/scene.hpp"

namespace harness {

/// The rows are the robot and then the landmarks, in the order in which they joined the map. If there are
/// more of them than cells, a cell shows its strongest block.
class MatrixPicture {
 public:
  /// Reads the whole matrix. `map` gives the order of the landmarks.
  void read(const seif::Estimator& filter, const PointIndex& map);

  /// Share of the blocks that are not zero. [-]
  double fill() const { return fill_; }
  seif::BeliefMatrix matrix() const { return matrix_; }
  bool empty() const { return cells_.empty(); }

  int size() const { return size_; }                          // [-] cells along an edge
  const std::vector<float>& cells() const { return cells_; }  // (size x size) strengths [-]
  /// How dark a cell of this strength is in a picture of such a matrix, in [0, 1]. [-]
  static float darkness(seif::BeliefMatrix matrix, float strength);
  /// Strengths that explain the scale, ascending. [-]
  static std::array<float, 3> ticks(seif::BeliefMatrix matrix);

  render::Raster raster(const Eigen::Vector2f& min, const Eigen::Vector2f& max) const;
  /// A strip from white to black, whose place from left to right is the darkness.
  static render::Raster scale(const Eigen::Vector2f& min, const Eigen::Vector2f& max);

 private:
  seif::BeliefMatrix matrix_ = seif::BeliefMatrix::none;
  int size_ = 0;              // [-] cells along an edge
  std::vector<float> cells_;  // (size x size) strengths [-]
  double fill_ = 0.0;
  std::vector<seif::Coupling> couplings_;  // reused
  std::unordered_map<seif::LandmarkId, std::size_t> numbers_;
};

}  // namespace harness
