// The live path: joining, activation, the solution, and reading. How the zone moves is planned in
// condensation_planning.cpp, made ready in condensation_sending.cpp, done in condensation_switching.cpp.
#include "seif/tree/condensation_tree.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdint>
#include <limits>

#include "seif/tree/leaf_element.hpp"

namespace seif {

// Leaves.

/// While a plan runs, a new leaf stands beside the tree.
int CondensationTree::add_leaf(const Eigen::Vector2d& p_world) {
  const int leaf = tree_.new_leaf();
  tree_.widen(leaf, p_world);
  if (plan_.is_running) {
    plan_.new_leaves.push_back(leaf);
  } else {
    attach(leaf);
  }
  while (static_cast<int>(nodes_.size()) < tree_.size()) nodes_.push_back({});
  node(leaf).hot = node(leaf).next_hot = true;
  node(leaf).used = scan_;
  hot_leaves_.push_back(leaf);
  return leaf;
}

/// By the middle of its box.
void CondensationTree::attach(int leaf) {
  tree_.attach(leaf);
  while (static_cast<int>(nodes_.size()) < tree_.size()) nodes_.push_back({});
  changed_.push_back(leaf);
}

/// The nearest hot leaf that has room, or a new one.
int CondensationTree::leaf_for(const Eigen::Vector2d& p, const Eigen::Vector2d& home) {
  int nearest = none;
  double shortest = std::numeric_limits<double>::infinity();
  for (const int leaf : hot_leaves_) {
    if (node(leaf).landmarks >= options_.most_in_leaf || !node(leaf).next_hot) continue;
    const double distance = (zone_.mean(landmark(node(leaf).first_landmark).zone_index) - p).squaredNorm();
    if (distance >= shortest) continue;
    shortest = distance;
    nearest = leaf;
  }
  return nearest != none ? nearest : add_leaf(home);
}

void CondensationTree::join(const InformationState& state, int slot) {
  const Eigen::Vector2d home = state.mean(slot) + homes_.offset();
  const int leaf = leaf_for(state.mean(slot), home);
  landmarks_.push_back({.leaf = leaf, .next = node(leaf).first_landmark, .home = home});
  landmark(slot).zone_index = zone_.add(slot, state.mean(slot));
  node(leaf).first_landmark = slot;
  tree_.widen(leaf, home);
  ++node(leaf).landmarks;
  ++epoch_;
}

void CondensationTree::hold(const InformationState& state, std::span<const int> slots, double sd) {
  held_leaf_ = tree_.new_leaf();
  nodes_.push_back({});
  node(held_leaf_).hot = node(held_leaf_).next_hot = true;
  held_weight_ = 1.0 / (sd * sd);
  for (const int slot : slots) {
    landmarks_.push_back(
        {.leaf = held_leaf_, .next = node(held_leaf_).first_landmark, .home = state.mean(slot)});
    node(held_leaf_).first_landmark = slot;
    ++node(held_leaf_).landmarks;
    landmark(slot).zone_index = zone_.add(slot, state.mean(slot));
    held_.push_back({slot, state.mean(slot)});
  }
  anchor_zone();
  ++epoch_;
}

void CondensationTree::anchor_zone() {
  for (const Held& held : held_) {
    const int h = landmark(held.slot).zone_index;
    zone_.add_information(h, h, held_weight_ * Eigen::Matrix2d::Identity());
    zone_.add_residual(h, held_weight_ * (held.at - zone_.mean(h)));
  }
}

// The window.

bool CondensationTree::activate(InformationState& state, std::vector<int>& slots, double range) {
  ++scan_;
  constexpr double kept = 0.99;  // of it, at a scan that sees less far
  view_ = std::max(range, kept * view_);
  note_travel(state);
  for (int p = 0; p < state.active_count(); ++p) node(landmark(state.active(p)).leaf).used = scan_;
  for (const int slot : slots) node(landmark(slot).leaf).used = scan_;
  for (const int slot : wanted_) node(landmark(slot).leaf).used = scan_;
  if (!plan_.is_running && choose_hot_leaves(state, slots)) begin_plan(state);
  wanted_.clear();
  if (plan_.is_running && !work_on_plan(state)) return false;
  waited_ += static_cast<std::int64_t>(std::erase_if(slots, [&](int slot) { return !is_ready(slot); }));
  zone_indices_.clear();
  for (const int slot : slots) {
    const int h = landmark(slot).zone_index;
    if (state.position(slot) < 0 && std::ranges::find(zone_indices_, h) == zone_indices_.end()) {
      zone_indices_.push_back(h);
    }
  }
  if (zone_indices_.empty()) return true;
  follow_in_zone(state);
  ++epoch_;
  if (!zone_.restore(zone_indices_)) return false;
  for (const int h : zone_indices_) {
    state.set_mean(zone_.slot(h), zone_.mean(h));
    state.activate(zone_.slot(h));
  }
  return true;
}

/// Whether a landmark may be active: in this zone and, if one is planned, in the next.
bool CondensationTree::is_ready(int slot) const {
  return landmark(slot).zone_index != none && node(landmark(slot).leaf).next_hot;
}

/// The zone moves once the messages are ready and have told their residuals.
bool CondensationTree::work_on_plan(InformationState& state) {
  if (plan_.has_told) return move_zone(state);
  const std::int64_t before = blocks_touched_;
  if (!make_ready(plan_.most_blocks)) return false;
  plan_.worked = blocks_touched_ - before;
  const bool is_all_at_once = options_.most_blocks == 0;
  return !is_all_at_once || move_zone(state);
}

bool CondensationTree::solve_all(InformationState& state) {
  if (plan_.is_running && !(make_ready(0) && move_zone(state))) return false;
  groups_allowed_ = false;
  begin_plan_of_all(state);
  const bool done = make_ready(0) && move_zone(state) && solve_window(state);
  groups_allowed_ = true;
  return done;
}

bool CondensationTree::freeze(const InformationState& state, std::span<const FrozenPiece> pieces) {
  follow_in_zone(state);
  ++epoch_;
  zone_indices_.clear();
  for (const FrozenPiece& piece : pieces) {
    zone_indices_.push_back(landmark(piece.slot).zone_index);
    add_to_zone(piece);
    if (plan_.is_running) {
      plan_.fresh.add(piece);
    } else {
      add_to_element(piece);
    }
  }
  return zone_.eliminate(zone_indices_);
}

/// Its members are active, or were before this sparsification.
void CondensationTree::add_to_zone(const FrozenPiece& piece) {
  const auto index_of = [&](int slot) { return landmark(slot).zone_index; };
  const Eigen::Vector2d y = seif::residual_of(piece, [&](int slot) { return zone_.mean(index_of(slot)); });
  for (const FrozenPiece::Member& m : piece.members) {
    zone_.add_residual(index_of(m.slot), m.V * y);
    for (const FrozenPiece::Member& n : piece.members) {
      if (index_of(n.slot) <= index_of(m.slot))
        zone_.add_information(index_of(m.slot), index_of(n.slot), m.V * n.V.transpose());
    }
  }
}

/// The leaf of one of its members whose element mentions most of them already: so elements stay small.
int CondensationTree::owner_of(const FrozenPiece& piece) {
  int best = none;
  std::size_t least = 0;
  const auto consider = [&](int leaf) {
    ++visit_;
    for (const Condensed::Member& m : node(leaf).own.boundary) landmark(m.variable).visit = visit_;
    std::size_t missing = 0;
    for (const FrozenPiece::Member& m : piece.members) {
      if (landmark(m.slot).visit != visit_) ++missing;
    }
    if (best != none && missing >= least) return;
    best = leaf;
    least = missing;
  };
  consider(landmark(piece.slot).leaf);
  for (const FrozenPiece::Member& m : piece.members) {
    if (const int leaf = landmark(m.slot).leaf; leaf != best && leaf != held_leaf_) consider(leaf);
  }
  return best;
}

void CondensationTree::add_to_element(const FrozenPiece& piece) {
  const int owner = owner_of(piece);
  Condensed& element = node(owner).own;
  element_mover_.turn(motion_in_zone(element), element);
  ++visit_;
  for (std::size_t i = 0; i < element.boundary.size(); ++i) {
    CondensedLandmark& p = landmark(element.boundary[i].variable);
    p.visit = visit_;
    p.row = static_cast<int>(i);
  }
  for (const FrozenPiece::Member& m : piece.members) {
    CondensedLandmark& p = landmark(m.slot);
    if (p.visit == visit_) continue;
    p.visit = visit_;
    p.row = static_cast<int>(element.boundary.size());
    element.boundary.push_back({m.slot, 0});
    if (p.leaves == 0 && p.leaf != owner) {
      Condensed& home = node(p.leaf).own;
      home.boundary.push_back({m.slot, 0});
      grow(front_.pool(), home);
      Eigen::Map<Eigen::Vector2d>(&home.reference[home.reference.size() - 2]) = m.reference;
      ++p.leaves;
    }
    ++p.leaves;
  }
  add_piece(
      piece, [&](int slot) { return landmark(slot).row; }, front_.pool(), element);
  blocks_touched_ += static_cast<std::int64_t>(piece.members.size() * (piece.members.size() + 1) / 2);
}

/// The information on the active landmarks of all that is frozen (w x w).
void CondensationTree::add_condensed(const InformationState& state, Eigen::Ref<Eigen::MatrixXd> Omega) const {
  for (int p = 0; p < state.active_count(); ++p) {
    const int h = landmark(state.active(p)).zone_index;
    for (int q = 0; q < state.active_count(); ++q) {
      Omega.block<2, 2>(InformationState::row_of(p), InformationState::row_of(q)) +=
          zone_.block(h, landmark(state.active(q)).zone_index);
    }
  }
}

bool CondensationTree::solve_window(InformationState& state) {
  const int w = state.window_size();
  if (M_.rows() < w) {
    M_.resize(2 * w, 2 * w);
    step_.resize(2 * w);
    change_.resize(2 * w);
    factor_.storage.resize(2 * w, 2 * w);
  }
  auto M = M_.topLeftCorner(w, w);
  M = state.Omega();
  add_condensed(state, M);
  factor_.size = w;
  auto L = factor_.L();
  L = M;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(L);
  if (llt.info() != Eigen::Success) return false;
  auto r = change_.head(w);
  r = state.r();
  for (int p = 0; p < state.active_count(); ++p) {
    const int h = landmark(state.active(p)).zone_index;
    r.segment<2>(InformationState::row_of(p)) +=
        zone_.residual(h, [&](int slot) { return state.mean(slot); });
  }
  auto d = step_.head(w);
  d = r;
  llt.solveInPlace(d);
  factor_.chi_square_drop = r.dot(d);
  r.noalias() = state.Omega() * d;
  state.move_window(d, r);
  state.touch(2 * state.window_blocks());
  ++epoch_;
  return true;
}

/// With L of Omega + S = L L' and columns Y that take a step of the window to one of pose or landmark, of
/// those that are not active by -W': the covariance is (L^-1 Y)' (L^-1 Y), and F_PP^-1 beside it.
void CondensationTree::covariance(const InformationState& state, std::span<const int> slots,
                                  Eigen::Ref<Eigen::MatrixXd> out) const {
  const int w = state.window_size();
  const auto n = static_cast<Eigen::Index>(3 + 2 * slots.size());
  if (by_factor_.rows() < w || by_factor_.cols() < n) {
    // Mostly enough, so that it does not come to grow when the map is long known.
    constexpr Eigen::Index room = 128;
    by_factor_.resize(std::max({room, Eigen::Index{2} * w, by_factor_.rows()}),
                      std::max({room, 2 * n, by_factor_.cols()}));
  }
  auto Y = by_factor_.topLeftCorner(w, n);
  Y.setZero();
  Y.topLeftCorner<3, 3>().setIdentity();
  Eigen::Index col = 3;
  for (const int slot : slots) {
    const int h = landmark(slot).zone_index;
    if (const int p = state.position(slot); p >= 0) {
      Y.block<2, 2>(InformationState::row_of(p), col).setIdentity();
    } else {
      for (int p_active = 0; p_active < state.active_count(); ++p_active)
        Y.block<2, 2>(InformationState::row_of(p_active), col) =
            -zone_.block(landmark(state.active(p_active)).zone_index, h);
    }
    col += 2;
  }
  factor_.L().triangularView<Eigen::Lower>().solveInPlace(Y);
  out.noalias() = Y.transpose() * Y;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = 0; j < slots.size(); ++j) {
      if (state.position(slots[i]) >= 0 || state.position(slots[j]) >= 0) continue;
      out.block<2, 2>(static_cast<Eigen::Index>(3 + 2 * i), static_cast<Eigen::Index>(3 + 2 * j)) -=
          zone_.block(landmark(slots[i]).zone_index, landmark(slots[j]).zone_index);
    }
  }
}

// Means. Reading leaves no trace: what it finds goes to read_, and holds until epoch_ counts on. Following
// writes it down where the next step starts from.

const Eigen::VectorXd& CondensationTree::read_zone(const InformationState& state) const {
  if (zone_read_at_ != epoch_) zone_.follow([&](int slot) { return state.mean(slot); }, zone_read_);
  zone_read_at_ = epoch_;
  return zone_read_;
}

void CondensationTree::read_mean(FrontVariable v, double* mean) const {
  if (is_group(v)) {
    Eigen::Map<Eigen::Vector3d>(mean, 3) = node(~v).group.read;
  } else if (const int h = landmark(v).zone_index; h != none) {
    Eigen::Map<Eigen::Vector2d>(mean, 2) = zone_read_.segment<2>(2 * h);
  } else {
    Eigen::Map<Eigen::Vector2d>(mean, 2) = landmark(v).read;
  }
}

/// What was settled at this node, and at all from there to the hub, follows its boundary.
void CondensationTree::read(const InformationState& state, int at) const {
  const Node& n = node(at);
  if (n.read_at == epoch_) return;
  n.read_at = epoch_;
  if (const int next = tree_.towards(at); next != none) {
    read(state, next);
  } else {
    read_zone(state);
  }
  const Condensed& message = sent(at).message;
  if (message.e == 0 && message.tied.empty()) return;
  const BodyMotion motion = find_step(message);
  Eigen::Index row = 0;
  for (const FrontVariable v : message.eliminated) {
    if (is_group(v)) {
      LandmarkGroup const& group = node(~v).group;
      group.read = group.mean + read_step_.segment<3>(row);
      turn_group(motion, group);
    } else {
      landmark(v).read = motion.moved(landmark(v).mean + read_step_.segment<2>(row));
    }
    row += freedom(v);
  }
  for (const Condensed::Tie& tie : message.tied) {
    const Eigen::Vector3d d = read_step_.segment<3>(tie.row);
    const Eigen::Vector2d t = d.head<2>() + lever_step(tie.lever, d(2));
    if (is_group(tie.variable)) {
      LandmarkGroup const& group = node(~tie.variable).group;
      group.read = tie.reference + Eigen::Vector3d(t.x(), t.y(), d(2));
      turn_group(motion, group);
    } else {
      landmark(tie.variable).read = motion.moved(tie.reference.head<2>() + t);
    }
  }
}

/// The steps of E and B since the message was sent, in read_step_: d_E = L^-T (y - G d_B).
BodyMotion CondensationTree::find_step(const Condensed& message) const {
  const Eigen::Index e = message.e;
  const Eigen::Index b = message.b;
  if (read_step_.size() < e + b) read_step_.resize(2 * (e + b));
  auto d_E = read_step_.head(e);
  auto d_B = read_step_.segment(e, b);
  const BodyMotion motion = step_of(message, d_B);
  const auto columns = message.L_and_G();
  d_E = Eigen::Map<const Eigen::VectorXd>(message.y.data(), e);
  d_E.noalias() -= columns.bottomRows(b).transpose() * d_B;
  columns.topRows(e).triangularView<Eigen::Lower>().transpose().solveInPlace(d_E);
  return motion;
}

Eigen::Vector2d CondensationTree::mean(const InformationState& state, int slot) const {
  if (state.position(slot) >= 0) return state.mean(slot);
  if (const int h = landmark(slot).zone_index; h != none) return read_zone(state).segment<2>(2 * h);
  read(state, landmark(slot).settled_at);
  return landmark(slot).read;
}

void CondensationTree::follow_in_zone(const InformationState& state) {
  if (zone_followed_at_ == epoch_) return;
  zone_followed_at_ = epoch_;
  zone_.set_means(read_zone(state));
  blocks_touched_ += std::int64_t{state.active_count()} * zone_.size();
}

int CondensationTree::settled_at(FrontVariable v) const {
  return is_group(v) ? node(~v).group.settled_at : landmark(v).settled_at;
}

std::size_t CondensationTree::memory_bytes() const {
  std::size_t bytes = tree_.memory_bytes() + nodes_.memory_bytes() + landmarks_.memory_bytes() +
                      front_.memory_bytes() + zone_.memory_bytes() + to_zone_.message.memory_bytes();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    bytes += nodes_[i].sent.message.memory_bytes() + nodes_[i].own.memory_bytes();
  for (const SentMessage& planned : plan_.messages) bytes += sizeof(planned) + planned.message.memory_bytes();
  return bytes;
}

}  // namespace seif
