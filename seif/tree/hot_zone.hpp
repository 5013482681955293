// The landmarks around the robot, with the information of all others about them: the innermost ring.
//
// F (2h x 2h) holds all frozen information about the zone's h landmarks: everything but that of the window
// (InformationState). s (2h) is its residual where the means were last written down; of P it is zero.
// Active landmarks, A, are linked to the robot. The others, P, are eliminated by the sweep operator, which leaves
// in place how they follow:
//
//         A                       P
//     A [ S = F_AA - F_AP W'      W = F_AP F_PP^-1 ]     the window solves with Omega + S; where the mean of
//     P [ W'                      -F_PP^-1         ]     A goes by d_A, that of P goes by -W' d_A
//
// Sweeping with the opposite sign takes a landmark back from P to A. So a landmark changes sides at the cost of one
// product of this size: no elimination begins anew.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seif/tree/front.hpp"
#include "seif/tree/moved_boundary.hpp"

namespace seif {

class HotZone {
 public:
  /// Loads the landmarks on the boundary of `all`, the condensed map, with its residual; all in A, at mean zero.
  void load(const Condensed& all);

  /// Adds a landmark to A that only the window knows. Returns its index in the zone.
  int add(int slot, const Eigen::Vector2d& mean);

  /// What was known where its landmarks were before goes to `places`, where they are now. Before any is in P.
  void bring(MovedBoundary& moved, std::span<const MovedPlace> places);

  int size() const { return static_cast<int>(members_.size()); }
  int slot(int index) const { return member(index).slot; }
  bool is_active(int index) const { return member(index).active; }

  auto block(int a, int b) { return F_.block<2, 2>(2 * a, 2 * b); }
  auto block(int a, int b) const { return F_.block<2, 2>(2 * a, 2 * b); }
  /// Adds to both blocks of a pair; to one block if a and b are the same.
  void add_information(int a, int b, const Eigen::Matrix2d& Omega_ab);
  auto residual(int index) { return s_.segment<2>(2 * index); }

  /// From A to P, which moves them to where their residual is zero, or from P to A. False, with nothing changed,
  /// if their block is not positive definite.
  [[nodiscard]] bool eliminate(std::span<const int> indices);
  [[nodiscard]] bool restore(std::span<const int> indices) { return sweep(indices, -1.0); }

  Eigen::Vector2d mean(int index) const { return mean_.segment<2>(2 * index); }
  void set_mean(int index, const Eigen::Vector2d& mean) { mean_.segment<2>(2 * index) = mean; }
  /// The means of all (2h) after A has moved to mean_of(slot) and P has followed.
  template <class MeanOf>
  void follow(MeanOf&& mean_of, Eigen::VectorXd& means) const {
    const Eigen::Index n = 2 * size();
    if (means.size() < n) means.resize(2 * n);
    means.head(n).setZero();
    for (int a = 0; a < size(); ++a) {
      if (is_active(a)) means.segment<2>(2 * a) = mean_of(slot(a)) - mean(a);
    }
    for (int p = 0; p < size(); ++p) {
      if (!is_active(p)) means.segment<2>(2 * p) = step_of(p, means);
    }
    means.head(n) += mean_.head(n);
  }
  /// Writes these means down, which follow() has computed, and the residual there.
  void set_means(const Eigen::VectorXd& means);
  /// The residual of an index in A after A has moved to mean_of(slot) and P has followed.
  template <class MeanOf>
  Eigen::Vector2d residual(int index, MeanOf&& mean_of) const {
    Eigen::Vector2d s = s_.segment<2>(2 * index);
    for (int a = 0; a < size(); ++a) {
      if (is_active(a)) s -= block(index, a) * (mean_of(slot(a)) - mean(a));
    }
    return s;
  }

  std::int64_t blocks_touched() const { return blocks_touched_; }
  std::size_t memory_bytes() const;

 private:
  struct Member {
    int slot;
    bool active;
  };
  const Member& member(int index) const { return members_[static_cast<std::size_t>(index)]; }
  std::int64_t all_blocks() const { return std::int64_t{size()} * (size() + 1) / 2; }
  void reserve(int landmarks);
  void list_rest(std::span<const int> indices);
  void spread_change(double sign, Eigen::Ref<Eigen::MatrixXd> change);
  bool sweep(std::span<const int> indices, double sign);
  Eigen::Vector2d step_of(int index, const Eigen::VectorXd& d) const;

  std::vector<Member> members_;
  Eigen::MatrixXd F_;     // symmetric, with room to grow
  Eigen::VectorXd mean_;  // with room to grow, as all below [m]
  Eigen::VectorXd s_;
  std::vector<int> rest_;                             // indices that a sweep does not take
  Eigen::VectorXd columns_, swept_, pivot_, change_;  // matrices of a sweep, with room to grow
  Eigen::VectorXd step_;
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
