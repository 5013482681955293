#include "seif/dense/symmetric_downdate.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace seif {
namespace {

constexpr int tile = SymmetricDowndate::tile;
using TileColumn = Eigen::Matrix<double, tile, 1>;

/// Subtracts the product of `Tiles` tiles of rows of W, at `rows`, and one tile of columns of W', at
/// `columns`, from the tiles of Sigma at `sigma`. The sums stay in registers over all of the width of W.
template <int Tiles>
void subtract_product(double* sigma, Eigen::Index stride, const double* rows, const double* columns,
                      int width) {
  std::array<std::array<TileColumn, Tiles>, tile> sum;
  for (int c = 0; c < tile; ++c) {
    for (int t = 0; t < Tiles; ++t) sum[c][t] = Eigen::Map<const TileColumn>(sigma + c * stride + t * tile);
  }
  for (int q = 0; q < width; ++q) {
    std::array<TileColumn, Tiles> a;
    for (int t = 0; t < Tiles; ++t) a[t] = Eigen::Map<const TileColumn>(rows + (t * width + q) * tile);
    for (int c = 0; c < tile; ++c) {
      const double b = columns[q * tile + c];
      for (int t = 0; t < Tiles; ++t) sum[c][t] -= a[t] * b;
    }
  }
  for (int c = 0; c < tile; ++c) {
    for (int t = 0; t < Tiles; ++t) Eigen::Map<TileColumn>(sigma + c * stride + t * tile) = sum[c][t];
  }
}

}  // namespace

void SymmetricDowndate::operator()(Eigen::MatrixXd& Sigma, const Eigen::Ref<const Eigen::MatrixXd>& W) {
  const auto n = static_cast<int>(W.rows());
  const auto width = static_cast<int>(W.cols());
  const int tiles = (n + tile - 1) / tile;
  assert(tiles * tile <= Sigma.rows() && Sigma.rows() == Sigma.cols() && Sigma.rows() % tile == 0);

  const auto tile_of_rows = [&](int t) {
    return by_rows_.data() + static_cast<std::size_t>(t) * width * tile;
  };
  by_rows_.resize(std::max(by_rows_.size(), static_cast<std::size_t>(tiles) * width * tile));
  for (int t = 0; t < tiles; ++t) {
    Eigen::Map<Eigen::Matrix<double, tile, Eigen::Dynamic>> packed(tile_of_rows(t), tile, width);
    const int rows = std::min(tile, n - t * tile);
    packed.topRows(rows) = W.middleRows(t * tile, rows);
    packed.bottomRows(tile - rows).setZero();
  }

  const Eigen::Index stride = Sigma.outerStride();
  for (int column = 0; column < tiles; ++column) {
    double* sigma = Sigma.data() + column * tile * (stride + 1);
    int row = column;
    for (; row + 1 < tiles; row += 2, sigma += 2 * tile) {
      subtract_product<2>(sigma, stride, tile_of_rows(row), tile_of_rows(column), width);
    }
    if (row < tiles) subtract_product<1>(sigma, stride, tile_of_rows(row), tile_of_rows(column), width);
  }
}

}  // namespace seif
