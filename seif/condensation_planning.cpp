// How the hot zone moves, and which messages are sent anew.
#include <algorithm>

#include "seif/condensation_tree.hpp"

namespace seif {

/// next_hot_: the leaves of the landmarks that are active or seen, and those last used that still have room
/// beside them. False if the zone may stay as it is.
bool CondensationTree::choose_hot_leaves(const InformationState& state, std::span<const int> slots) {
  next_hot_.clear();
  int landmarks = 0;
  const auto want = [&](int leaf) {
    if (node(leaf).wanted) return;
    node(leaf).wanted = true;
    landmarks += node(leaf).landmarks;
    next_hot_.push_back(leaf);
  };
  for (int p = 0; p < state.active_count(); ++p) want(place(state.active(p)).leaf);
  for (const int slot : slots) want(place(slot).leaf);
  const bool all_hot = std::ranges::all_of(next_hot_, [&](int leaf) { return node(leaf).hot; });
  const bool may_stay = all_hot && zone_.size() <= options_.most_hot;
  if (!may_stay) {
    std::ranges::sort(hot_leaves_, [&](int a, int b) {
      return node(a).used != node(b).used ? node(a).used > node(b).used : a > b;
    });
    for (const int leaf : hot_leaves_) {
      if (node(leaf).wanted) continue;
      if (landmarks + node(leaf).landmarks > options_.most_hot) break;
      want(leaf);
    }
  }
  for (const int leaf : next_hot_) node(leaf).wanted = false;
  return !may_stay && !(all_hot && next_hot_.size() == hot_leaves_.size());
}

/// To next_hot_. Only messages that now say something else, or go elsewhere, are sent anew: those on the way
/// from a leaf that has become hot or cold to the hub, from the old hub to the new one, and with groups that
/// are now too near.
bool CondensationTree::move_zone(InformationState& state) {
  mark_changed_leaves();
  const int hub = tree_.common_ancestor(next_hot_);
  stale_.clear();
  for (const int leaf : changed_) mark_stale(state, leaf);
  mark_stale(state, hub);
  mark_expired(state, tree_.hub());
  return send_stale(state, hub);
}

bool CondensationTree::solve_all(InformationState& state) {
  next_hot_ = hot_leaves_;
  stale_.clear();
  for (int at = 0; at < tree_.size(); ++at) mark_stale(state, at);
  groups_allowed_ = false;
  const bool done = send_stale(state, tree_.common_ancestor(next_hot_)) && solve_window(state);
  groups_allowed_ = true;
  return done;
}

bool CondensationTree::send_stale(InformationState& state, int hub) {
  for (const int at : stale_) {
    tree_.for_each_neighbour(at, [&](int other) { note_groups(node(other).message); });
  }
  note_zone_residual(state);
  switch_leaves(state, hub);
  return fill_zone(state);
}

void CondensationTree::mark_changed_leaves() {
  for (const int leaf : next_hot_) node(leaf).wanted = true;
  for (const int leaf : hot_leaves_) {
    if (!node(leaf).wanted) changed_.push_back(leaf);
  }
  for (const int leaf : next_hot_) {
    if (!node(leaf).hot) changed_.push_back(leaf);
    node(leaf).wanted = false;
  }
}

/// From a node to the hub as it still is; what is settled there is read.
void CondensationTree::mark_stale(const InformationState& state, int at) {
  for (int i = at; i != none; i = tree_.towards(i)) {
    if (node(i).stale_since == epoch_) break;
    node(i).stale_since = epoch_;
    node(i).is_stale = true;
    stale_.push_back(i);
  }
  read(state, at);
}

/// Nodes with a group in their fronts that the next zone is too near to, and what depends on them.
void CondensationTree::mark_expired(const InformationState& state, int at) {
  const Node& n = node(at);
  const bool changes = n.stale_since == epoch_;
  const auto enters = [&](int leaf) { return n.reach.intersects(tree_.box(leaf)); };
  if (!changes && std::ranges::none_of(next_hot_, enters)) return;
  if (!changes &&
      std::ranges::any_of(n.groups, [&](int g) { return distance_ratio(g) < 0.5 * options_.grain; })) {
    mark_stale(state, at);
  }
  tree_.for_each_source(at, [&](int source) { mark_expired(state, source); });
}

/// The groups of a boundary that has been read.
void CondensationTree::note_groups(const Condensed& message) {
  for (const Condensed::Member& m : message.boundary) {
    if (is_group(m.variable)) node(~m.variable).group.known = epoch_;
  }
}

void CondensationTree::reserve_boundary(Eigen::Index rows) {
  if (rows <= part_step_.size()) return;
  part_step_.resize(2 * rows);
  part_residual_.resize(2 * rows);
}

/// What a message holds of the residual of its boundary, as that is now.
Eigen::VectorXd::SegmentReturnType CondensationTree::residual_of(const Condensed& message) {
  reserve_boundary(message.b);
  auto d = part_step_.head(message.b);
  auto r = part_residual_.head(message.b);
  step_of(message, d);
  message.residual(d, r);
  blocks_touched_ += message.blocks();
  return r;
}

/// What the messages to a node hold of the residual of hot landmarks. A node that has come in between since
/// has none of its own yet.
void CondensationTree::take_from_loose(int at) {
  tree_.for_each_source(at, [&](int source) {
    if (node(source).is_new) return take_from_loose(source);
    const Condensed& m = node(source).message;
    const auto r = residual_of(m);
    Eigen::Index row = 0;
    for (const Condensed::Member& member : m.boundary) {
      const FrontVariable v = member.variable;
      if (!is_group(v) && place(v).hot != none) place(v).loose -= r.segment<2>(row);
      row += freedom(v);
    }
  });
}

/// What no message holds of the residual: of hot landmarks, and where hot leaves have blocks with cold ones.
void CondensationTree::note_zone_residual(const InformationState& state) {
  for (int h = 0; h < zone_.size(); ++h) {
    Place& p = place(zone_.slot(h));
    const int position = state.position(zone_.slot(h));
    p.loose.setZero();
    if (position >= 0) p.loose = state.r().segment<2>(InformationState::row_of(position));
  }
  take_from_loose(tree_.hub());
  const Condensed& to_zone = node(tree_.hub()).message;
  reserve_boundary(to_zone.b);
  auto d = part_step_.head(to_zone.b);
  step_of(to_zone, d);
  Eigen::Index row = 0;
  for (const Condensed::Member& member : to_zone.boundary) {
    const int slot = member.variable;
    state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
      if (place(other).hot != none || place(other).leaf < place(slot).leaf) return;
      place(other).loose -= Omega_so.transpose() * d.segment<2>(row);
    });
    row += 2;
  }
}

/// A cold leaf whose message goes: what its message held of the residual.
void CondensationTree::loosen(int leaf) {
  const Condensed& m = node(leaf).message;
  const auto r = residual_of(m);
  Eigen::Index row = 0;
  for (const Condensed::Member& member : m.boundary) {
    place(member.variable).loose += r.segment<2>(row);
    row += 2;
  }
}

void CondensationTree::switch_leaves(const InformationState& state, int hub) {
  for (const int at : stale_) {
    if (tree_.is_leaf(at) && !node(at).hot) loosen(at);
  }
  for (int h = 0; h < zone_.size(); ++h) {
    Place& p = place(zone_.slot(h));
    p.read = zone_read_.segment<2>(2 * h);
    p.hot = none;
  }
  for (const int leaf : hot_leaves_) node(leaf).hot = false;
  for (const int leaf : next_hot_) node(leaf).hot = true;
  hot_leaves_ = next_hot_;
  tree_.move_hub(hub, way_);
  for (const int leaf : changed_) {
    if (node(leaf).hot) continue;
    for_each_landmark(leaf, [&](int slot) { place(slot).leaves = count_leaves(state, slot); });
  }
  changed_.clear();
}

/// How many leaves mention a passive landmark: its own, and those before it that own a block of it.
int CondensationTree::count_leaves(const InformationState& state, int slot) const {
  owners_.clear();
  owners_.push_back(place(slot).leaf);
  state.for_each_neighbour(slot, [&](int other, const auto&) {
    const int leaf = place(other).leaf;
    if (leaf < owners_.front() && std::ranges::find(owners_, leaf) == owners_.end()) owners_.push_back(leaf);
  });
  return static_cast<int>(owners_.size());
}

}  // namespace seif
