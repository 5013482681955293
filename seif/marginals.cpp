#include "seif/marginals.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <utility>

#include "seif/full_state.hpp"

namespace seif {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLLT<Sparse, Eigen::Lower>;  // P A P' = L L'

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Overwrites L (with A = L L') by A^-1 on the pattern of L, last column first. For i > j, over the rows k of
/// column j:
///   Z_ij = -sum_k Z_ik L_kj / L_jj,   Z_jj = 1 / L_jj^2 - sum_k Z_kj L_kj / L_jj.
/// Every Z_ik in these sums lies on the pattern, since the elimination of j links its rows pairwise.
void invert_on_pattern(Sparse& L) {
  const int n = static_cast<int>(L.cols());
  const int* starts = L.outerIndexPtr();
  const int* rows = L.innerIndexPtr();
  double* values = L.valuePtr();
  Eigen::VectorXi index_of = Eigen::VectorXi::Constant(n, -1);  // of a row in the column at work
  std::vector<double> column;                                   // L_kj / L_jj
  std::vector<double> sums;                                     // sum_k Z_ik L_kj / L_jj
  for (int j = n - 1; j >= 0; --j) {
    const int first = starts[j] + 1;  // the diagonal comes first
    const int count = starts[j + 1] - first;
    const double pivot = values[starts[j]];
    column.assign(values + first, values + first + count);
    for (double& l : column) l /= pivot;
    sums.assign(static_cast<std::size_t>(count), 0.0);
    for (int a = 0; a < count; ++a) index_of(rows[first + a]) = a;
    for (int a = 0; a < count; ++a) {
      const int k = rows[first + a];
      for (int e = starts[k]; e < starts[k + 1]; ++e) {
        const int b = index_of(rows[e]);
        if (b < 0) continue;
        sums[static_cast<std::size_t>(b)] += values[e] * column[static_cast<std::size_t>(a)];
        if (b != a) sums[static_cast<std::size_t>(a)] += values[e] * column[static_cast<std::size_t>(b)];
      }
    }
    double diagonal = 1.0 / (pivot * pivot);
    for (int a = 0; a < count; ++a) {
      const auto i = static_cast<std::size_t>(a);
      values[first + a] = -sums[i];
      diagonal += sums[i] * column[i];
      index_of(rows[first + a]) = -1;
    }
    values[starts[j]] = diagonal;
  }
}

/// The next column on the path up the elimination tree; -1 at its root.
int parent(const Sparse& L, int column) {
  const int below = L.outerIndexPtr()[column] + 1;  // the diagonal comes first
  return below < L.outerIndexPtr()[column + 1] ? L.innerIndexPtr()[below] : -1;
}

/// These rows and columns of A^-1: W' W with W = L^-1 P E, where E has these columns of the identity. Only
/// those rows of W that lie on the paths from `rows` up the elimination tree are not zero, and only they are
/// stored. `index_of` (n x 1) is -1 before and after.
Eigen::MatrixXd block_of_inverse(const Factor& factor, std::span<const int> rows, Eigen::VectorXi& index_of) {
  const Sparse& L = factor.matrixL().nestedExpression();
  const auto& permuted = factor.permutationP().indices();
  std::vector<int> ways;
  for (const int row : rows) {
    for (int j = permuted(row); j >= 0 && index_of(j) < 0; j = parent(L, j)) {
      index_of(j) = 0;
      ways.push_back(j);
    }
  }
  std::ranges::sort(ways);
  for (std::size_t k = 0; k < ways.size(); ++k) index_of(ways[k]) = static_cast<int>(k);
  Rows W = Rows::Zero(static_cast<Eigen::Index>(ways.size()), static_cast<Eigen::Index>(rows.size()));
  for (std::size_t c = 0; c < rows.size(); ++c)
    W(index_of(permuted(rows[c])), static_cast<Eigen::Index>(c)) = 1.0;
  for (const int j : ways) {
    Sparse::InnerIterator entry(L, j);
    auto w = W.row(index_of(j));
    w /= entry.value();
    for (++entry; entry; ++entry) W.row(index_of(entry.row())) -= entry.value() * w;
  }
  for (const int j : ways) index_of(j) = -1;
  return W.transpose() * W;
}

/// [-] the entries of L that the recursion of invert_on_pattern() reads.
double work_of_whole_pattern(const Sparse& L) {
  double work = 0.0;
  for (int j = 0; j < L.cols(); ++j) {
    for (Sparse::InnerIterator entry(L, j); entry; ++entry)
      work += static_cast<double>(L.col(entry.row()).nonZeros());
  }
  return work;
}

/// [-] the entries of L that block_of_inverse() reads for these blocks, a path shared by two rows counted twice.
double work_of_blocks(const Factor& factor, std::span<const std::vector<int>> blocks) {
  const Sparse& L = factor.matrixL().nestedExpression();
  // The entries on the path from each column to its root.
  Eigen::VectorXd from = Eigen::VectorXd::Zero(L.cols());
  for (int j = static_cast<int>(L.cols()) - 1; j >= 0; --j) {
    const int above = parent(L, j);
    from(j) = static_cast<double>(L.col(j).nonZeros()) + (above >= 0 ? from(above) : 0.0);
  }
  double work = 0.0;
  for (const std::vector<int>& rows : blocks) {
    for (const int row : rows) work += from(factor.permutationP().indices()(row));
  }
  return work;
}

std::vector<Eigen::MatrixXd> one_by_one(const Factor& factor, std::span<const std::vector<int>> blocks) {
  Eigen::VectorXi index_of = Eigen::VectorXi::Constant(factor.rows(), -1);
  std::vector<Eigen::MatrixXd> inverse;
  inverse.reserve(blocks.size());
  for (const std::vector<int>& rows : blocks) inverse.push_back(block_of_inverse(factor, rows, index_of));
  return inverse;
}

/// The entry (i, j) of the inverse that Z holds. It must lie on Z's pattern.
double entry_on_pattern(const Sparse& Z, const Eigen::VectorXi& permuted, int i, int j) {
  const auto [low, high] = std::minmax(permuted(i), permuted(j));
  const int* rows = Z.innerIndexPtr();
  const int* begin = rows + Z.outerIndexPtr()[low];
  const int* end = rows + Z.outerIndexPtr()[low + 1];
  const int* found = std::lower_bound(begin, end, high);
  assert(found != end && *found == high);
  return Z.valuePtr()[found - rows];
}

Eigen::MatrixXd block_on_pattern(const Sparse& Z, const Eigen::VectorXi& permuted,
                                 std::span<const int> rows) {
  const auto size = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd block(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j)
      block(i, j) =
          entry_on_pattern(Z, permuted, rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
  }
  return block;
}

/// The blocks from the inverse on the whole pattern.
std::vector<Eigen::MatrixXd> all_at_once(const Factor& factor, std::span<const std::vector<int>> blocks) {
  Sparse Z = factor.matrixL();
  invert_on_pattern(Z);
  std::vector<Eigen::MatrixXd> inverse;
  inverse.reserve(blocks.size());
  for (const std::vector<int>& rows : blocks)
    inverse.push_back(block_on_pattern(Z, factor.permutationP().indices(), rows));
  return inverse;
}

}  // namespace

std::optional<std::vector<Eigen::MatrixXd>> blocks_of_inverse(const Sparse& A,
                                                              std::span<const std::vector<int>> blocks) {
  const Factor factor(A);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return one_by_one(factor, blocks);
}

std::optional<MarginalCovariances> marginals_of(const Sparse& Omega, int pose_row,
                                                std::span<const int> landmark_rows) {
  std::vector<std::vector<int>> blocks = {{pose_row, pose_row + 1, pose_row + 2}};
  for (const int row : landmark_rows) blocks.push_back({row, row + 1});
  const Factor factor(Omega);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Sparse& L = factor.matrixL().nestedExpression();
  const bool are_few = work_of_blocks(factor, blocks) < work_of_whole_pattern(L);
  const std::vector<Eigen::MatrixXd> Sigma =
      are_few ? one_by_one(factor, blocks) : all_at_once(factor, blocks);
  return MarginalCovariances{.pose = Sigma.front(), .landmarks = {Sigma.begin() + 1, Sigma.end()}};
}

std::optional<MarginalCovariances> marginals_of(const InformationState& state,
                                                std::span<const LandmarkId> landmarks) {
  std::vector<int> rows;
  for (const LandmarkId landmark : landmarks)
    rows.push_back(InformationState::row_of(state.find(landmark).value()));
  return marginals_of(full_Omega(state), 0, rows);
}

std::optional<std::vector<Eigen::MatrixXd>> joint_covariances_of(const InformationState& state,
                                                                 std::span<const LandmarkIds> groups) {
  const auto row_of = [&](LandmarkId id) { return InformationState::row_of(state.find(id).value()); };
  std::vector<std::vector<int>> blocks;
  for (const LandmarkIds& group : groups) blocks.push_back(joint_rows(group, row_of));
  return blocks_of_inverse(full_Omega(state), blocks);
}

}  // namespace seif
