// The result of a front: the condensed matrix and residual of its boundary (formulas: front.hpp).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seif/aligned_numbers.hpp"
#include "seif/tree/array_pool.hpp"
#include "seif/tree/group_motion.hpp"

namespace seif {

/// A landmark is named by its slot, a group by the complement of its node's number.
using FrontVariable = int;
constexpr FrontVariable group_variable(int group) { return ~group; }
constexpr bool is_group(FrontVariable v) { return v < 0; }
/// A landmark has two unknowns, a group those of GroupMotion.
constexpr int freedom(FrontVariable v) { return is_group(v) ? GroupMotion::SizeAtCompileTime : 2; }

/// The result of a front.
struct Condensed {
  struct Member {
    FrontVariable variable;
    /// [-] Leaves behind that hold blocks of it. Once its own leaf is among them, minus the number of all such leaves.
    int balance;
  };
  struct Tie {
    FrontVariable variable;
    int row;  // of its group, in E and B
    Lever lever;
    GroupMotion reference;  // its mean (the first two, or all of a group) at that of B
  };
  std::vector<FrontVariable> eliminated;
  std::vector<Member> boundary;
  std::vector<Tie> tied;
  int e = 0, b = 0;          // [-] rows of E, of B
  ArrayPool::Array factor;   // (e + b x e) [L; G'], by column
  ArrayPool::Array S;        // (b x b) lower triangle, by column
  AlignedNumbers y;          // (e)
  AlignedNumbers s;          // (b) the residual where B is at its reference
  AlignedNumbers reference;  // (b) of B; what its mean has gone since is d_B

  auto L_and_G() const { return Eigen::Map<const Eigen::MatrixXd>(factor.data(), e + b, e); }
  /// S in full to `full` (b x b), and back.
  void unpack(Eigen::Ref<Eigen::MatrixXd> full) const;
  void pack(const Eigen::Ref<const Eigen::MatrixXd>& full);
  /// Distinct blocks of 2 x 2 in the matrix of E and B, and in that of B alone.
  std::int64_t blocks() const { return blocks_of(e + b); }
  std::int64_t boundary_blocks() const { return blocks_of(b); }
  /// Blocks that are touched where E is computed from B: those of L and G.
  std::int64_t reading_blocks() const { return blocks() - boundary_blocks() + static_cast<int>(tied.size()); }
  /// Of a symmetric matrix with so many rows.
  static std::int64_t blocks_of(std::int64_t rows) { return (rows + 1) / 2 * ((rows + 1) / 2 + 1) / 2; }
  /// Adds a 2 x 2 block to S at (row, col), row >= col; on the diagonal its lower triangle.
  void add_to_S(Eigen::Index row, Eigen::Index col, const Eigen::Matrix2d& block);
  /// s - S d: the residual of B after its mean has moved by d (b) from its reference.
  void residual(const Eigen::Ref<const Eigen::VectorXd>& d, Eigen::Ref<Eigen::VectorXd> r) const;
  void clear();
  /// Takes over the other's arrays; copies its lists, so that each keeps its own capacity.
  void take(Condensed& other);
  /// Without the arrays, which belong to the front.
  std::size_t memory_bytes() const;
};

}  // namespace seif
