#include "seif/marginals.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <utility>

namespace seif {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLLT<Sparse, Eigen::Lower>;  // P A P' = L L'

/// [-] So many landmarks cost less one by one than by inverting the whole pattern, even in a long ring, whose
/// elimination tree is as high as it is long.
constexpr std::size_t few = 64;

template <int size>
using Rows = Eigen::Matrix<double, Eigen::Dynamic, size, Eigen::RowMajor>;

/// Overwrites L (with A = L L') by A^-1 on the pattern of L, last column first. For i > j, over the rows k of
/// column j:
///   Z_ij = -sum_k Z_ik L_kj / L_jj,   Z_jj = 1 / L_jj^2 - sum_k Z_kj L_kj / L_jj.
/// Every Z_ik that is asked for lies on the pattern, since elimination of j links its rows pairwise.
void invert_on_pattern(Sparse& L) {
  const int n = static_cast<int>(L.cols());
  const int* starts = L.outerIndexPtr();
  const int* rows = L.innerIndexPtr();
  double* values = L.valuePtr();
  Eigen::VectorXi place = Eigen::VectorXi::Constant(n, -1);  // of a row in the column at work
  std::vector<double> column;                                // L_kj / L_jj
  std::vector<double> sums;                                  // sum_k Z_ik L_kj / L_jj
  for (int j = n - 1; j >= 0; --j) {
    const int first = starts[j] + 1;  // the diagonal comes first
    const int count = starts[j + 1] - first;
    const double pivot = values[starts[j]];
    column.assign(values + first, values + first + count);
    for (double& l : column) l /= pivot;
    sums.assign(static_cast<std::size_t>(count), 0.0);
    for (int a = 0; a < count; ++a) place(rows[first + a]) = a;
    for (int a = 0; a < count; ++a) {
      const int k = rows[first + a];
      for (int e = starts[k]; e < starts[k + 1]; ++e) {
        const int b = place(rows[e]);
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
      place(rows[first + a]) = -1;
    }
    values[starts[j]] = diagonal;
  }
}

/// The block of A^-1 on the diagonal whose first row is `row`: W' W with W = L^-1 P E, E being these columns
/// of the identity. Of the rows of W only those are not zero that lie on the way from the first of its own up
/// the elimination tree; its other own rows do too, since A links them all. `W` (n x size) is zero, and is
/// again afterwards.
template <int size>
Eigen::Matrix<double, size, size> block_of_inverse(const Factor& factor, int row, Rows<size>& W) {
  const Sparse& L = factor.matrixL().nestedExpression();
  const auto own = factor.permutationP().indices().segment<size>(row);
  for (int i = 0; i < size; ++i) W(own(i), i) = 1.0;
  Eigen::Matrix<double, size, size> block = Eigen::Matrix<double, size, size>::Zero();
  for (int j = own.minCoeff(); j >= 0;) {
    Sparse::InnerIterator entry(L, j);  // the diagonal comes first
    const Eigen::Matrix<double, 1, size> w = W.row(j) / entry.value();
    W.row(j).setZero();
    block += w.transpose() * w;
    ++entry;
    j = entry ? static_cast<int>(entry.row()) : -1;  // the parent
    for (; entry; ++entry) W.row(entry.row()) -= entry.value() * w;
  }
  return block;
}

/// For a few landmarks of a large map: at the cost of the factor and one way up the elimination tree for
/// each.
std::optional<MarginalCovariances> marginals_of_few(const InformationState& state,
                                                    std::span<const LandmarkId> landmarks) {
  const Factor factor(state.full_Omega());
  if (factor.info() != Eigen::Success) return std::nullopt;
  Rows<3> W_pose = Rows<3>::Zero(factor.rows(), 3);
  Rows<2> W = Rows<2>::Zero(factor.rows(), 2);
  MarginalCovariances marginals{.pose = block_of_inverse<3>(factor, 0, W_pose), .landmarks = {}};
  for (const LandmarkId landmark : landmarks) {
    const int row = InformationState::row_of(state.find(landmark).value());
    marginals.landmarks.push_back(block_of_inverse<2>(factor, row, W));
  }
  return marginals;
}

}  // namespace

std::optional<DiagonalBlocksOfInverse> DiagonalBlocksOfInverse::of(const Sparse& A) {
  const Factor llt(A);
  if (llt.info() != Eigen::Success) return std::nullopt;
  DiagonalBlocksOfInverse inverse;
  inverse.permuted_ = llt.permutationP().indices();
  inverse.Z_ = llt.matrixL();
  invert_on_pattern(inverse.Z_);
  return inverse;
}

double DiagonalBlocksOfInverse::operator()(int i, int j) const {
  const auto [low, high] = std::minmax(permuted_(i), permuted_(j));
  const int* rows = Z_.innerIndexPtr();
  const int* begin = rows + Z_.outerIndexPtr()[low];
  const int* end = rows + Z_.outerIndexPtr()[low + 1];
  const int* found = std::lower_bound(begin, end, high);
  assert(found != end && *found == high);
  return Z_.valuePtr()[found - rows];
}

std::optional<Eigen::Matrix<double, Eigen::Dynamic, 3>> columns_of_inverse(const Sparse& A, int first) {
  const Factor factor(A);
  if (factor.info() != Eigen::Success) return std::nullopt;
  Eigen::Matrix<double, Eigen::Dynamic, 3> E = Eigen::MatrixXd::Zero(A.rows(), 3);
  E.middleRows<3>(first).setIdentity();
  return factor.solve(E);
}

JointCovariance joint_covariance(const Eigen::Matrix3d& pose, const Eigen::Matrix<double, 3, 2>& cross,
                                 const Eigen::Matrix2d& landmark) {
  JointCovariance joint;
  joint << pose, cross, cross.transpose(), landmark;
  return joint;
}

std::vector<LandmarkEstimate> map_of(const InformationState& state) {
  std::vector<LandmarkEstimate> map;
  map.reserve(static_cast<std::size_t>(state.landmark_count()));
  for (int slot = 0; slot < state.landmark_count(); ++slot) map.push_back({state.id(slot), state.mean(slot)});
  return map;
}

Eigen::MatrixXd dense_Omega_of(const InformationState& state) {
  const Eigen::MatrixXd lower = state.full_Omega();
  return lower.selfadjointView<Eigen::Lower>();
}

void landmarks_of(const InformationState& state, std::span<const LandmarkId> landmarks,
                  std::vector<LandmarkEstimate>& out) {
  out.clear();
  for (const LandmarkId landmark : landmarks) {
    if (const auto slot = state.find(landmark)) out.push_back({landmark, state.mean(*slot)});
  }
}

std::optional<MarginalCovariances> marginals_of(const InformationState& state,
                                                std::span<const LandmarkId> landmarks) {
  if (landmarks.size() <= few && landmarks.size() < static_cast<std::size_t>(state.landmark_count())) {
    return marginals_of_few(state, landmarks);
  }
  const std::optional<DiagonalBlocksOfInverse> Sigma = DiagonalBlocksOfInverse::of(state.full_Omega());
  if (!Sigma) return std::nullopt;
  MarginalCovariances marginals{.pose = Sigma->block<3>(0), .landmarks = {}};
  for (const LandmarkId landmark : landmarks)
    marginals.landmarks.push_back(Sigma->block<2>(InformationState::row_of(state.find(landmark).value())));
  return marginals;
}

std::optional<std::vector<JointCovariance>> joint_covariances_of(const InformationState& state,
                                                                 std::span<const LandmarkId> landmarks) {
  const std::optional<MarginalCovariances> marginals = marginals_of(state, landmarks);
  const auto columns = columns_of_inverse(state.full_Omega(), 0);  // of the pose
  if (!marginals || !columns) return std::nullopt;
  std::vector<JointCovariance> joint;
  joint.reserve(landmarks.size());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const int row = InformationState::row_of(state.find(landmarks[i]).value());
    joint.push_back(
        joint_covariance(marginals->pose, columns->middleRows<2>(row).transpose(), marginals->landmarks[i]));
  }
  return joint;
}

}  // namespace seif
