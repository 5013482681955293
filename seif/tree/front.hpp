// Eliminates landmarks from a part of the information matrix: the work of a node of the condensation tree.
//
//   a part of Omega       eliminated E   boundary B
//   (a front)         E [ M_EE                      ]       M_EE = L L',  G = L^-1 M_EB,  y = L^-1 r_E
//                     B [ M_BE           M_BB       ]       condensed: S = M_BB - G' G,  s = r_B - G' y
//
// E must have all its blocks in this front. If the mean of B moves by d_B, that of E moves by
// L^-T (y - G d_B). The work is done in small steps, so that it can be spread over updates:
//
//   begin, add each part, tie  ->  divide into E and B  ->  assemble each part  ->  eliminate some columns at a time
//   ->  finish
//
// The variables of a front are landmarks, and groups of landmarks (group_motion.hpp). A tied landmark has no rows of its
// own: it moves with its group.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "seif/tree/array_pool.hpp"
#include "seif/tree/condensed.hpp"
#include "seif/tree/front_rows.hpp"
#include "seif/tree/moved_boundary.hpp"
#include "seif/tree/moved_part.hpp"

namespace seif {

/// Must live longer than its results, whose arrays are from its pool.
class Front {
 public:
  struct Variable {
    FrontVariable variable;
    int balance;
    FrontVariable group;  // that it is tied to, or itself
    Lever lever;
  };
  struct Part {
    const Condensed* condensed;
    bool is_in_place;  // its reference is where its variables are
  };

  Front() = default;
  Front(const Front&) = delete;
  Front& operator=(const Front&) = delete;  // arrays of the pool that goes may be in use
  ~Front() = default;

  void begin();
  /// Adds the result of another front, or a part of Omega.
  void add(const Condensed& part, bool is_in_place = true);
  /// All variables so far, in the order in which they were added.
  const std::vector<Variable>& variables() const { return variables_; }
  /// Ties a variable to a group, which is added to the front if it is missing.
  void tie(std::size_t index, FrontVariable group, const Lever& lever);
  /// A group that begins here resists dilation a little, so that few members, or members on a line, determine it.
  void damp(FrontVariable group) { damped_.push_back(group); }

  /// Eliminates all variables for which is_complete(variable, balance) holds. `out` may not be one that was added, and
  /// must stay until finish(), which sets all of it but `reference`.
  template <class IsComplete>
  void divide(IsComplete&& is_complete, Condensed& out) {
    out.clear();
    for (const Variable& v : variables_) {
      if (v.group != v.variable) continue;
      if (is_complete(v.variable, v.balance)) {
        out.eliminated.push_back(v.variable);
        out.e += freedom(v.variable);
      } else {
        out.boundary.push_back({v.variable, v.balance});
        out.b += freedom(v.variable);
      }
    }
    begin_matrix(out);
  }
  /// The part that assemble_next() will add, or null.
  const Part* next_part() const { return next_part_ < parts_.size() ? &parts_[next_part_] : nullptr; }
  /// `places`: of the part's boundary, unless it is in place already.
  void assemble_next(const Turning& turning, std::span<const MovedPlace> places);
  bool has_columns_left() const { return next_column_ < e_; }
  /// False if the block of E is not positive definite.
  [[nodiscard]] bool eliminate_next();
  void finish();

  /// All steps; all parts must be in place.
  template <class IsComplete>
  [[nodiscard]] bool condense(IsComplete&& is_complete, Condensed& out) {
    divide(is_complete, out);
    while (next_part() != nullptr) assemble_next({}, {});
    while (has_columns_left()) {
      if (!eliminate_next()) return false;
    }
    finish();
    return true;
  }

  /// Of the arrays of its results.
  ArrayPool& pool() { return pool_; }
  std::int64_t blocks_touched() const { return blocks_touched_; }
  std::size_t memory_bytes() const;

 private:
  std::size_t index_of(FrontVariable v);
  void begin_matrix(Condensed& out);
  void add_untied(const double* S);
  void add_tied(Eigen::Index b, const double* S);
  void list_moved_rows();
  void add_residual(const double* r);
  double& entry(int i, int j);
  std::ptrdiff_t col_of_B(std::ptrdiff_t row) const { return (row - e_) * (size_ - e_); }
  static void fold(double* square, Eigen::Index stride, Eigen::Index n);

  ArrayPool pool_;
  FrontRows rows_;
  std::vector<Variable> variables_;
  std::vector<FrontVariable> damped_;
  std::vector<Part> parts_;
  std::size_t next_part_ = 0;
  MovedPart moved_;
  std::vector<int> moved_rows_, column_of_row_;
  Condensed* out_ = nullptr;
  int size_ = 0, e_ = 0, next_column_ = 0;  // rows in all, of E, and those that are done
  double* of_E_ = nullptr;  // (n x e) columns of the matrix: in the message that is being made
  Eigen::VectorXd of_B_;    // (b x b), with room to grow, as all below
  Eigen::VectorXd half_, transposed_;
  Eigen::VectorXd r_;
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
