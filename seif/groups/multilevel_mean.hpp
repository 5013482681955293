// Recovers the mean in steps of bounded work, by rigid motions of groups of landmarks of every size.
//
// Relaxing one landmark after another hardly reduces an error that is smooth over many of them. So landmarks form
// groups of about ten, these form larger groups, and so on. A group of any level can be moved as a rigid body:
//
//   level 2               [        a        ]        by (t, phi) about the group's centre c:
//   level 1        [    b    ][    c    ][    d    ]    p <- p + t + phi J (p - c)
//   landmarks      o o o o o o o o o o o o o o o o
//
// The equations of a level are Galerkin's: A = B' Omega B and R = B' r. The columns of B are the rigid motions of
// its groups; the robot follows the landmarks. A motion is applied when a mean is read: the mean of a passive
// landmark is its stored mean plus the motions of its groups since. So a step costs the same in any map, except
// for the number of levels, which grows with the logarithm of the map.
//
// Glossary: d: motion of a group (3); total: d with the motions of the groups above; q: force, the dual of a motion
//           (3); missing: the present mean of a passive landmark minus the stored one; pull: the effect of missing
//           on the r of other landmarks.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/groups/rigid_group.hpp"
#include "seif/information_state.hpp"

namespace seif {

struct MultilevelOptions {
  double over_correction = 1.3;  // [-] of a group's step: rigid groups make a level too stiff
  int other_groups = 4;          // [-] of each level that are moved in turn, beside those about the window
  int relaxed_groups = 2;  // [-] whose landmarks are relaxed one by one: one about the window, others in turn
};

class MultilevelMean {
 public:
  explicit MultilevelMean(const MultilevelOptions& options) : options_(options) {}

  /// Puts a landmark that has just joined the map into a group of active landmarks.
  void join(const InformationState& state, int slot);

  /// Takes a passive landmark into the window, with its present mean.
  void activate(InformationState& state, int slot);

  /// p_world_landmark, with the motions of its groups. [m]
  Eigen::Vector2d mean(const InformationState& state, int slot) const;

  /// Before and after a scan's information is added; all known landmarks that it sees are active both times.
  /// The equations of the groups change by the difference.
  /// False if the robot's block is not positive definite.
  [[nodiscard]] bool before_information(const InformationState& state);
  [[nodiscard]] bool after_information(const InformationState& state);

  /// The mean of robot and active landmarks given that of the others. False, with nothing changed, if the
  /// window's Omega is not positive definite.
  [[nodiscard]] bool solve_window(InformationState& state);

  /// Moves the groups around the window and a few others, from the largest to the smallest, then single
  /// landmarks, then solves for the window again. False as above.
  [[nodiscard]] bool correct(InformationState& state);

  /// Sum of R' A^-1 R over the groups of level 1, each as it was when last touched [-]. Divided by one plus the
  /// largest number of neighbours of a group, it is a lower bound of the squared error of the mean in sigma.
  double residual() const { return residual_; }

  std::int64_t blocks_touched() const { return blocks_touched_; }
  std::size_t memory_bytes() const;

 private:
  using Group = RigidGroup;
  using Member = GroupMember;

  Group& group(int i) { return groups_[static_cast<std::size_t>(i)]; }
  const Group& group(int i) const { return groups_[static_cast<std::size_t>(i)]; }
  Member& member(int slot) { return members_[static_cast<std::size_t>(slot)]; }
  const Member& member(int slot) const { return members_[static_cast<std::size_t>(slot)]; }

  int add_group(int level, const Eigen::Vector2d& centre);
  void add_root();
  int find_group(int level, const Eigen::Vector2d& position);
  void gather_groups_of_window(const InformationState& state);
  void go_up();

  const Eigen::Vector3d& total(int i) const;
  void move(int i, const Eigen::Vector3d& d);
  Eigen::Vector2d missing(int slot) const;
  Eigen::Vector2d pull(const InformationState& state, int slot);

  void add_force(int i, const Eigen::Vector3d& q);
  void add_force_of(int slot, const Eigen::Vector2d& f);
  void pass_forces_on();
  void gather_change(const InformationState& state);
  void add_change_to_groups();
  void shift_change_to_parents();
  void sum_change_by_parent();
  void add_information(int i, int j, const Eigen::Matrix3d& A);
  Eigen::Matrix3d& link(int i, int j);

  Eigen::Vector3d residual_force(int i) const;
  void relax(int i);
  void note_residual(int i, double residual);
  void relax_landmarks(InformationState& state, int i);
  void relax_landmark(InformationState& state, int slot);
  [[nodiscard]] bool carry_window(InformationState& state);
  /// The first w entries of step_ (w x 1).
  Eigen::VectorXd::SegmentReturnType window_step(const InformationState& state);

  MultilevelOptions options_;
  mutable ChunkedArray<Group> groups_;  // mutable for cached totals
  ChunkedArray<Member> members_;        // by slot
  int root_ = -1;
  std::vector<ChunkedArray<int>> levels_;      // groups, by level - 1
  std::vector<std::size_t> turn_;              // whose turn it is, by level - 1
  std::vector<std::vector<int>> have_forces_;  // groups, by level - 1
  std::size_t near_turn_ = 0;
  std::size_t any_turn_ = 0;
  std::vector<int> near_;           // the groups of one level that hold the window
  std::vector<int> index_in_near_;  // by position in the window, or by group of the level below
  int visit_ = 0;
  std::int64_t motions_ = 0;
  double residual_ = 0.0;
  std::int64_t blocks_touched_ = 0;

  int active_before_ = 0;
  Eigen::MatrixXd D_before_, D_after_;             // (2k x 2k) information of the window without the robot
  Eigen::MatrixXd change_, change_above_;          // (3g x 3g) of the groups in near_
  Eigen::Matrix<double, Eigen::Dynamic, 3> half_;  // (2k x 3)
  Eigen::VectorXd step_;                           // (w x 1), with room to grow
};

}  // namespace seif
