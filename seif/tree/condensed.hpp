// The result of a front: the condensed matrix and residual of its boundary (formulas: front.hpp).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seif/tree/array_pool.hpp"

namespace seif {

/// A landmark is named by its slot, a group by the complement of its node's number.
using FrontVariable = int;
constexpr FrontVariable group_variable(int group) { return ~group; }
constexpr bool is_group(FrontVariable v) { return v < 0; }
constexpr int freedom(FrontVariable v) { return is_group(v) ? 3 : 2; }  // (x, y), or (x, y, phi)

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
    Eigen::Matrix<double, 2, 1, Eigen::DontAlign> lever;
    Eigen::Matrix<double, 3, 1, Eigen::DontAlign> reference;  // its mean (2, or 3 of a group) at that of B
  };
  std::vector<FrontVariable> eliminated;
  std::vector<Member> boundary;
  std::vector<Tie> tied;
  int e = 0, b = 0;               // [-] rows of E, of B
  ArrayPool::Array factor;        // (e + b x e) [L; G'], by column
  ArrayPool::Array S;             // (b x b) lower triangle, by column
  std::vector<double> y;          // (e)
  std::vector<double> s;          // (b) the residual where B is at its reference
  std::vector<double> reference;  // (b) of B; what its mean has gone since is d_B

  auto L_and_G() const { return Eigen::Map<const Eigen::MatrixXd>(factor.data(), e + b, e); }
  /// S in full to `full` (b x b), and back.
  void unpack(Eigen::Ref<Eigen::MatrixXd> full) const;
  void pack(const Eigen::Ref<const Eigen::MatrixXd>& full);
  /// The number of its distinct blocks.
  std::int64_t blocks() const;
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
