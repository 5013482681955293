// Eliminates landmarks from a part of the information matrix: the work of a node of the condensation tree.
//
//   a part of Omega       eliminated E   boundary B
//   (a front)         E [ M_EE                      ]       M_EE = L L',  G = L^-1 M_EB,  y = L^-1 r_E
//                     B [ M_BE           M_BB       ]       condensed: S = M_BB - G' G,  s = r_B - G' y
//
// E must have all its blocks in this front. If the mean of B moves by d_B, that of E moves by
// L^-T (y - G d_B).
//
// The variables of a front are landmarks, and groups of landmarks that move as one rigid body. A tied landmark has
// no rows of its own; it moves by t + phi J lever when its group moves by (t, phi).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/tree/array_pool.hpp"
#include "seif/tree/condensed.hpp"
#include "seif/tree/moved_boundary.hpp"

namespace seif {

/// Must live longer than its results, whose arrays are from its pool.
class Front {
 public:
  struct Variable {
    FrontVariable variable;
    int balance;
    FrontVariable group;  // that it is tied to, or itself
    Eigen::Matrix<double, 2, 1, Eigen::DontAlign> lever;
  };

  Front() = default;
  Front(Front&&) = default;
  Front& operator=(Front&&) = delete;  // arrays of the pool that goes may be in use
  ~Front() = default;

  /// Of MovedBoundary. [m]
  void set_near(double near) { near_ = near; }
  void begin();
  /// Adds the result of another front, or a part of Omega.
  void add(const Condensed& part);
  /// The same, brought to where its variables are.
  void add(const Condensed& part, std::span<const MovedPlace> places) {
    add(part);
    if (part.boundary.empty()) return;
    parts_.back().first_place = static_cast<int>(places_.size());
    places_.insert(places_.end(), places.begin(), places.end());
  }
  /// All variables so far, in the order in which they were added.
  const std::vector<Variable>& variables() const { return variables_; }
  /// Ties a variable to a group, which is added to the front if it is missing.
  void tie(std::size_t index, FrontVariable group, const Eigen::Vector2d& lever);

  /// Eliminates all variables for which is_complete(variable, balance) holds. False if their block is not
  /// positive definite. `out` may not be one that was added. Sets all but y, s and reference.
  template <class IsComplete>
  [[nodiscard]] bool condense(IsComplete&& is_complete, Condensed& out) {
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
    return factorise(out);
  }

  // The residual of a condensed front.
  void begin_residual(const Condensed& front);
  /// Adds a part's residual of its boundary (b).
  void add_residual(const Condensed& part, const Eigen::Ref<const Eigen::VectorXd>& r);
  void add_residual(int slot, const Eigen::Vector2d& r);
  /// Sets y and s.
  void condense_residual(Condensed& front);

  /// Of the arrays of its results.
  ArrayPool& pool() { return *pool_; }
  /// The number of unknowns. [-]
  int size() const { return size_; }
  std::size_t memory_bytes() const;

 private:
  struct Rows {
    int front = 0;  // number of the front in which it was last
    int index = 0;  // among variables_, until it has a row
    int row = 0;
    bool tied = false;
    Eigen::Matrix<double, 2, 1, Eigen::DontAlign> lever;
  };
  /// The target of a row of a part: one row of the front, and for a tied landmark a second one with this weight.
  struct Target {
    int row;
    int second;
    double weight;
  };

  Rows& rows_of(FrontVariable v);
  std::size_t index_of(FrontVariable v);
  void give_rows(const Condensed& front);
  void add_targets(FrontVariable v);
  void find_targets(const Condensed& part);
  void clear_matrix(Condensed& out);
  std::ptrdiff_t col_of_B(std::ptrdiff_t row) const { return (row - e_) * (size_ - e_); }
  double& entry(int i, int j);
  void add_product(const Target& i, const Target& j, double value, bool diagonal);
  struct Part {
    const Condensed* condensed;
    int first_place;  // among places_, or -1
  };
  const double* in_its_place(const Part& part);
  void add_untied(const double* S);
  void add_tied(const Condensed& part, const double* S);
  void list_moved_rows();
  void add_to_rows(const Target& target, double value);
  void assemble(Condensed& out);
  static void fold(double* square, Eigen::Index stride, Eigen::Index n);
  bool eliminate(Eigen::Index b);
  bool factorise(Condensed& out);

  std::unique_ptr<ArrayPool> pool_ = std::make_unique<ArrayPool>();  // stays where it is if the front moves
  int front_ = 0;
  int size_ = 0;
  ChunkedArray<Rows> landmarks_, groups_;
  std::vector<Variable> variables_;
  std::vector<Part> parts_;
  std::vector<MovedPlace> places_;  // of the variables of such parts
  std::vector<Target> targets_;     // of the rows of one part
  bool any_tied_ = false;           // among them
  std::vector<int> moved_rows_, column_of_row_;
  int e_ = 0;               // rows of E
  double* of_E_ = nullptr;  // (n x e) columns of the matrix: in the message that is being made
  Eigen::VectorXd of_B_;    // (b x b), with room to grow, as all below
  Eigen::VectorXd half_, transposed_, square_, turned_;
  Eigen::VectorXd r_;
  double near_ = 0.0;
  MovedBoundary moved_;
};

}  // namespace seif
