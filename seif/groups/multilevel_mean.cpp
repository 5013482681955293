#include "seif/groups/multilevel_mean.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <limits>

#include "seif/mean_recovery.hpp"

namespace seif {
namespace {

constexpr int most_landmarks = 10;  // [-] in a group of level 1
constexpr int most_groups = 5;      // [-] in a group of another level
constexpr double singular = 1e-9;   // [-] share of a motion's information that no other explains, to count

using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// B (2 x 3): how a point at `lever` from the centre of a group moves with it.
Matrix23 point_in_group(const Eigen::Vector2d& lever) {
  Matrix23 B;
  B << 1, 0, -lever.y(), 0, 1, lever.x();
  return B;
}

/// T (3 x 3): how a group whose centre lies there does.
Eigen::Matrix3d group_in_group(const Eigen::Vector2d& lever) {
  Eigen::Matrix3d T = Eigen::Matrix3d::Identity();
  T.topRightCorner<2, 1>() << -lever.y(), lever.x();
  return T;
}

/// Whether a group's equations A, with factor L, tell of each of its motions where it belongs.
bool is_regular(const Eigen::Matrix3d& A, const Eigen::LLT<Eigen::Matrix3d>& L) {
  return L.info() == Eigen::Success &&
         (L.matrixLLT().diagonal().array().square() > singular * A.diagonal().array()).all();
}

/// The one whose turn it is.
template <class Array>
int next_of(const Array& groups, std::size_t& turn) {
  return groups[turn++ % groups.size()];
}

void grow(Eigen::MatrixXd& matrix, Eigen::Index size) {
  if (matrix.rows() < size) matrix.resize(2 * size, 2 * size);
}

/// D = Omega_mm - Omega_mx Omega_xx^-1 Omega_xm over the window's landmarks (2k x 2k): the robot follows
/// them. False if Omega_xx is not positive definite.
[[nodiscard]] bool eliminate_robot(const InformationState& state,
                                   Eigen::Matrix<double, Eigen::Dynamic, 3>& half, Eigen::MatrixXd& D) {
  const auto Omega = state.Omega();
  const auto n = Omega.rows() - 3;
  grow(D, n);
  if (half.rows() < n) half.resize(2 * n, 3);
  const Eigen::LLT<Eigen::Matrix3d> Omega_xx(Eigen::Matrix3d(Omega.topLeftCorner<3, 3>()));
  if (Omega_xx.info() != Eigen::Success) return false;
  auto V = half.topRows(n);
  V = Omega.bottomLeftCorner(n, 3);
  Omega_xx.matrixU().solveInPlace<Eigen::OnTheRight>(V);
  D.topLeftCorner(n, n) = Omega.bottomRightCorner(n, n);
  D.topLeftCorner(n, n).noalias() -= V * V.transpose();
  return true;
}

}  // namespace

// The groups.

int MultilevelMean::add_group(int level, const Eigen::Vector2d& centre) {
  const int i = static_cast<int>(groups_.size());
  groups_.push_back({});
  group(i).level = level;
  group(i).centre = centre;
  group(i).members = 1;
  if (static_cast<std::size_t>(level) > levels_.size()) {
    levels_.emplace_back();
    have_forces_.emplace_back();
    turn_.push_back(0);
  }
  levels_[static_cast<std::size_t>(level - 1)].push_back(i);
  return i;
}

/// A level above all others. Its group knows what the root below it knows.
void MultilevelMean::add_root() {
  pass_forces_on();
  const int below = root_;
  root_ = add_group(group(below).level + 1, group(below).centre);
  group(below).parent = root_;
  group(root_).A = group(below).A;
  group(root_).S = group(below).S - group(below).A * group(below).d;
}

/// The group of a level for something new: of those in near_ that have room the nearest, or else a new one.
int MultilevelMean::find_group(int level, const Eigen::Vector2d& position) {
  int nearest = -1;
  double shortest = std::numeric_limits<double>::infinity();
  for (const int i : near_) {
    const double distance = (group(i).centre - position).squaredNorm();
    if (group(i).members >= (level == 1 ? most_landmarks : most_groups) || distance >= shortest) continue;
    shortest = distance;
    nearest = i;
  }
  if (nearest >= 0) {
    ++group(nearest).members;
    return nearest;
  }
  const int i = add_group(level, position);
  if (root_ < 0) {
    root_ = i;
    return i;
  }
  if (group(root_).level == level) add_root();
  go_up();
  const int parent = find_group(level + 1, position);
  group(i).parent = parent;
  return i;
}

/// near_: the groups of level 1 of the active landmarks; index_in_near_: where in it that of each position is.
void MultilevelMean::gather_groups_of_window(const InformationState& state) {
  ++visit_;
  near_.clear();
  index_in_near_.clear();
  for (int position = 0; position < state.active_count(); ++position) {
    const int slot = state.active(position);
    if (slot >= static_cast<int>(members_.size())) continue;  // the one that is joining
    const int i = member(slot).group;
    if (group(i).visit != visit_) {
      group(i).visit = visit_;
      near_.push_back(i);
    }
    index_in_near_.push_back(static_cast<int>(std::ranges::find(near_, i) - near_.begin()));
  }
}

/// From the groups in near_ to those that they are in; index_in_near_: where in near_ now is that of each.
void MultilevelMean::go_up() {
  ++visit_;
  index_in_near_.clear();
  std::size_t count = 0;
  for (const int i : near_) {
    const int parent = group(i).parent;
    if (parent < 0) continue;
    if (group(parent).visit != visit_) {
      group(parent).visit = visit_;
      near_[count++] = parent;
    }
    const auto parents_end = near_.begin() + static_cast<std::ptrdiff_t>(count);
    index_in_near_.push_back(static_cast<int>(std::find(near_.begin(), parents_end, parent) - near_.begin()));
  }
  near_.resize(count);
}

void MultilevelMean::join(const InformationState& state, int slot) {
  assert(slot == static_cast<int>(members_.size()));
  gather_groups_of_window(state);
  const Eigen::Vector2d p = state.mean(slot);
  const int i = find_group(1, p);
  members_.push_back({.group = i, .next = group(i).first_member, .lever = p - group(i).centre});
  group(i).first_member = slot;
  member(slot).stored = point_in_group(member(slot).lever) * total(i);
}

// Motions.

const Eigen::Vector3d& MultilevelMean::total(int i) const {
  Group& g = groups_[static_cast<std::size_t>(i)];
  if (g.cached_at == motions_) return g.cached_total;
  g.cached_total = g.d;
  if (g.parent >= 0) g.cached_total += group_in_group(g.centre - group(g.parent).centre) * total(g.parent);
  g.cached_at = motions_;
  return g.cached_total;
}

Eigen::Vector2d MultilevelMean::missing(int slot) const {
  const Member& m = member(slot);
  return point_in_group(m.lever) * total(m.group) - m.stored;
}

Eigen::Vector2d MultilevelMean::mean(const InformationState& state, int slot) const {
  return state.position(slot) >= 0 ? state.mean(slot) : Eigen::Vector2d(state.mean(slot) + missing(slot));
}

/// What the missing motions of its neighbours do to the r of a landmark.
Eigen::Vector2d MultilevelMean::pull(const InformationState& state, int slot) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
    ++blocks_touched_;
    if (state.position(other) < 0) sum -= Omega_so * missing(other);
  });
  return sum;
}

void MultilevelMean::activate(InformationState& state, int slot) {
  const Eigen::Vector2d d = missing(slot);
  state.move_landmark(slot, d);
  member(slot).stored += d;
  // The window is solved for, so what a landmark in it pulls at its groups does not count.
  add_force_of(slot, -(state.residual(slot) + pull(state, slot)));
  state.activate(slot);
}

// Forces and information.

void MultilevelMean::add_force(int i, const Eigen::Vector3d& q) {
  Group& g = group(i);
  g.q += q;
  if (g.has_forces) return;
  g.has_forces = true;
  have_forces_[static_cast<std::size_t>(g.level - 1)].push_back(i);
}

/// The r of a landmark changes by f.
void MultilevelMean::add_force_of(int slot, const Eigen::Vector2d& f) {
  add_force(member(slot).group, point_in_group(member(slot).lever).transpose() * f);
}

void MultilevelMean::pass_forces_on() {
  for (std::vector<int>& groups : have_forces_) {
    for (const int i : groups) {
      Group& g = group(i);
      g.S += g.q;
      if (g.parent >= 0) {
        add_force(g.parent, group_in_group(g.centre - group(g.parent).centre).transpose() * g.q);
      }
      g.q.setZero();
      g.has_forces = false;
      if (g.level == 1) {
        const Eigen::Vector3d R = residual_force(i);
        const Eigen::LLT<Eigen::Matrix3d> A(g.A);
        note_residual(i, is_regular(g.A, A) ? R.dot(A.solve(R)) : 0.0);
      }
    }
    groups.clear();
  }
}

Eigen::Matrix3d& MultilevelMean::link(int i, int j) {
  std::vector<RigidGroup::Link>& links = group(i).links;
  const auto it = std::ranges::find(links, j, &RigidGroup::Link::other);
  if (it != links.end()) return it->A;
  links.push_back({j, Eigen::Matrix3d::Zero()});
  return links.back().A;
}

/// A_ij += A, and A_ji; R stays.
void MultilevelMean::add_information(int i, int j, const Eigen::Matrix3d& A) {
  ++blocks_touched_;
  group(i).S += A * total(j);
  if (i == j) {
    group(i).A += A;
    return;
  }
  group(j).S += A.transpose() * total(i);
  link(i, j) += A;
  link(j, i) += A.transpose();
}

bool MultilevelMean::before_information(const InformationState& state) {
  active_before_ = state.active_count();
  if (active_before_ == 0) return true;
  blocks_touched_ += state.window_blocks();
  return eliminate_robot(state, half_, D_before_);
}

/// From the blocks of the window to those of its groups of level 1, from these to those of level 2, and so
/// on.
bool MultilevelMean::after_information(const InformationState& state) {
  if (state.active_count() == 0) return true;
  blocks_touched_ += state.window_blocks();
  if (!eliminate_robot(state, half_, D_after_)) return false;
  const int before = 2 * active_before_;
  if (before > 0) D_after_.topLeftCorner(before, before) -= D_before_.topLeftCorner(before, before);
  gather_groups_of_window(state);
  gather_change(state);
  add_change_to_groups();
  while (near_.front() != root_) {
    shift_change_to_parents();
    go_up();
    sum_change_by_parent();
    add_change_to_groups();
  }
  return true;
}

/// change_ (3g x 3g): what the groups in near_ know of each other changes by B' (D_after - D_before) B.
void MultilevelMean::gather_change(const InformationState& state) {
  const auto size = 3 * static_cast<Eigen::Index>(near_.size());
  grow(change_, size);
  change_.topLeftCorner(size, size).setZero();
  for (int p = 0; p < state.active_count(); ++p) {
    const Matrix23 B_p = point_in_group(member(state.active(p)).lever);
    const int row = 3 * index_in_near_[static_cast<std::size_t>(p)];
    for (int q = 0; q < state.active_count(); ++q) {
      const int col = 3 * index_in_near_[static_cast<std::size_t>(q)];
      change_.block<3, 3>(row, col) += B_p.transpose() * D_after_.block<2, 2>(2 * p, 2 * q) *
                                       point_in_group(member(state.active(q)).lever);
    }
  }
}

void MultilevelMean::add_change_to_groups() {
  const int groups = static_cast<int>(near_.size());
  for (int a = 0; a < groups; ++a) {
    for (int b = 0; b <= a; ++b) {
      add_information(near_[static_cast<std::size_t>(a)], near_[static_cast<std::size_t>(b)],
                      change_.block<3, 3>(3 * a, 3 * b));
    }
  }
}

/// change_ <- T' change_ T: each group's motion as one of its parent, about the parent's centre. Block by
/// block: of fixed size, in place and without a heap.
void MultilevelMean::shift_change_to_parents() {
  const int groups = static_cast<int>(near_.size());
  for (int a = 0; a < groups; ++a) {
    const Group& g = group(near_[static_cast<std::size_t>(a)]);
    const Eigen::Matrix3d T = group_in_group(g.centre - group(g.parent).centre);
    for (int b = 0; b < groups; ++b) {
      change_.block<3, 3>(3 * b, 3 * a) *= T;
      change_.block<3, 3>(3 * a, 3 * b).applyOnTheLeft(T.transpose());
    }
  }
}

/// Adds up the blocks of groups that have the same parent, once near_ holds the parents.
void MultilevelMean::sum_change_by_parent() {
  const int below = static_cast<int>(index_in_near_.size());
  const auto size = 3 * static_cast<Eigen::Index>(near_.size());
  grow(change_above_, size);
  change_above_.topLeftCorner(size, size).setZero();
  for (int a = 0; a < below; ++a) {
    const int row = 3 * index_in_near_[static_cast<std::size_t>(a)];
    for (int b = 0; b < below; ++b) {
      const int col = 3 * index_in_near_[static_cast<std::size_t>(b)];
      change_above_.block<3, 3>(row, col) += change_.block<3, 3>(3 * a, 3 * b);
    }
  }
  change_.swap(change_above_);
}

// The solution.

Eigen::VectorXd::SegmentReturnType MultilevelMean::window_step(const InformationState& state) {
  if (step_.size() < state.window_size()) step_.resize(2 * state.window_size());
  return step_.head(state.window_size());
}

bool MultilevelMean::solve_window(InformationState& state) {
  auto step = window_step(state);
  step = state.r();
  for (int p = 0; p < state.active_count(); ++p) {
    step.segment<2>(InformationState::row_of(p)) += pull(state, state.active(p));
  }
  if (!solve_for_window(state, step)) return false;
  state.move_window(step);
  for (int p = 0; p < state.active_count(); ++p) {
    const Eigen::Vector2d d = step.segment<2>(InformationState::row_of(p));
    state.for_each_neighbour(state.active(p), [&](int other, const auto& Omega_po) {
      ++blocks_touched_;
      if (state.position(other) < 0) add_force_of(other, -(Omega_po.transpose() * d));
    });
  }
  return true;
}

/// R of a group: how far its landmarks pull at it.
Eigen::Vector3d MultilevelMean::residual_force(int i) const {
  const Group& g = group(i);
  Eigen::Vector3d R = g.S - g.A * total(i);
  for (const RigidGroup::Link& l : g.links) R -= l.A * total(l.other);
  return R;
}

void MultilevelMean::note_residual(int i, double residual) {
  Group& g = group(i);
  residual_ += residual - g.residual;
  g.residual = residual;
}

/// Moves a group to where it is pulled no more, and a little further. The levels below feel it when they
/// look, those above in the next update.
void MultilevelMean::relax(int i) {
  Group& g = group(i);
  const Eigen::LLT<Eigen::Matrix3d> A(g.A);
  if (!is_regular(g.A, A)) return;
  const Eigen::Vector3d R = residual_force(i);
  const Eigen::Vector3d step = A.solve(R);
  const double left = 1.0 - options_.over_correction;
  if (g.level == 1) note_residual(i, left * left * R.dot(step));
  g.d += options_.over_correction * step;
  ++motions_;
  blocks_touched_ += 2 * static_cast<std::int64_t>(g.links.size() + 1);
  if (g.parent < 0) return;
  const auto pass_on = [&](const Group& from, const Eigen::Vector3d& q) {
    add_force(from.parent, group_in_group(from.centre - group(from.parent).centre).transpose() * q);
  };
  pass_on(g, -options_.over_correction * R);
  for (const RigidGroup::Link& l : g.links)
    pass_on(group(l.other), -options_.over_correction * (l.A.transpose() * step));
}

/// The best place for one landmark, all others given.
void MultilevelMean::relax_landmark(InformationState& state, int slot) {
  const Eigen::Vector2d unseen = missing(slot);
  const Eigen::Matrix2d Omega_ii = state.information(slot);
  const Eigen::LLT<Eigen::Matrix2d> llt(Omega_ii);
  if (llt.info() != Eigen::Success) return;
  const Eigen::Vector2d r = state.residual(slot) + pull(state, slot) - Omega_ii * unseen;
  const Eigen::Vector2d step = llt.solve(r);
  state.move_landmark(slot, unseen + step);
  member(slot).stored += unseen;
  add_force_of(slot, -r);
  state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
    ++blocks_touched_;
    add_force_of(other, -(Omega_so.transpose() * step));
  });
}

void MultilevelMean::relax_landmarks(InformationState& state, int i) {
  for (int slot = group(i).first_member; slot >= 0; slot = member(slot).next) {
    if (state.position(slot) < 0) relax_landmark(state, slot);
  }
}

/// The active landmarks go where their groups have gone, and the robot with them. False, with nothing moved,
/// if the robot's block is not positive definite.
bool MultilevelMean::carry_window(InformationState& state) {
  const auto Omega = state.Omega();
  const Eigen::LLT<Eigen::Matrix3d> Omega_xx(Eigen::Matrix3d(Omega.topLeftCorner<3, 3>()));
  if (Omega_xx.info() != Eigen::Success) return false;
  auto step = window_step(state);
  for (int p = 0; p < state.active_count(); ++p) {
    const Eigen::Vector2d d = missing(state.active(p));
    member(state.active(p)).stored += d;
    step.segment<2>(InformationState::row_of(p)) = d;
  }
  const auto landmarks = Omega.rows() - 3;
  const Eigen::Vector3d pulled = Omega.topRows<3>().rightCols(landmarks) * step.tail(landmarks);
  step.head<3>() = -Omega_xx.solve(pulled);
  state.move_window(step);
  return true;
}

bool MultilevelMean::correct(InformationState& state) {
  if (state.active_count() == 0) return true;
  pass_forces_on();
  for (int level = group(root_).level; level >= 1; --level) {
    gather_groups_of_window(state);
    for (int below = 1; below < level; ++below) go_up();
    for (const int i : near_) relax(i);
    const ChunkedArray<int>& all = levels_[static_cast<std::size_t>(level - 1)];
    std::size_t& turn = turn_[static_cast<std::size_t>(level - 1)];
    for (int k = 0; k < options_.other_groups; ++k) relax(next_of(all, turn));
  }
  if (!carry_window(state)) return false;
  gather_groups_of_window(state);
  for (int k = 0; k < options_.relaxed_groups; ++k) {
    relax_landmarks(state, k == 0 ? next_of(near_, near_turn_) : next_of(levels_.front(), any_turn_));
  }
  for (int p = 0; p < state.active_count(); ++p) {  // will be solved for, as above
    const int slot = state.active(p);
    add_force_of(slot, -(state.residual(slot) + pull(state, slot)));
  }
  return solve_window(state);
}

std::size_t MultilevelMean::memory_bytes() const {
  std::size_t bytes = groups_.memory_bytes() + members_.memory_bytes();
  for (const ChunkedArray<int>& level : levels_) bytes += level.memory_bytes();
  for (std::size_t i = 0; i < groups_.size(); ++i)
    bytes += groups_[i].links.capacity() * sizeof(RigidGroup::Link);
  return bytes;
}

}  // namespace seif
