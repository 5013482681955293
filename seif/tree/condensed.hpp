// What a front leaves behind: the condensed matrix and residual of its boundary (front.hpp has the formulas).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "seif/tree/array_pool.hpp"

namespace seif {

/// A landmark goes by its slot, a group by the complement of a number of its own.
using FrontVariable = int;
constexpr FrontVariable group_variable(int group) { return ~group; }
constexpr bool is_group(FrontVariable v) { return v < 0; }
constexpr int freedom(FrontVariable v) { return is_group(v) ? 3 : 2; }  // (x, y), or (x, y, phi)

/// What a front leaves behind.
struct Condensed {
  struct Member {
    FrontVariable variable;
    /// [-] leaves behind that hold blocks of it; once its own is among them, less all that there are.
    int balance;
  };
  /// Of the matrix of B, by places in the boundary; for i == j the lower triangle counts.
  struct Block {
    int i, j;
    Eigen::Matrix<double, 2, 2, Eigen::DontAlign> Omega_ij;
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
  std::vector<Block> S_blocks;    // S, where nothing has been eliminated, of landmarks alone
  int e = 0, b = 0;               // [-] rows of E, of B
  ArrayPool::Array factor;        // (e + b x e) [L; G'], by column
  ArrayPool::Array S;             // (b x b) lower triangle, by column
  std::vector<double> y;          // (e)
  std::vector<double> s;          // (b) the residual where B is at its reference
  std::vector<double> reference;  // (b) of B; what its mean has gone since is d_B

  auto L_and_G() const { return Eigen::Map<const Eigen::MatrixXd>(factor.data(), e + b, e); }
  /// The distinct blocks of it.
  std::int64_t blocks() const;
  /// s - S d: the residual of B where its mean has gone by d (b) since its reference.
  void residual(const Eigen::Ref<const Eigen::VectorXd>& d, Eigen::Ref<Eigen::VectorXd> r) const;
  void clear();
  /// Becomes the other, whose arrays it takes away; lists are copied, so that each keeps its own room.
  void take(Condensed& other);
  /// Without its arrays: those are the front's.
  std::size_t memory_bytes() const;
};

}  // namespace seif
