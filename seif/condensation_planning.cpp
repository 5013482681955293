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
/// from a leaf that has become hot or cold to the hub, and from the old hub to the new one.
bool CondensationTree::move_zone(const InformationState& state) {
  for (const int leaf : next_hot_) node(leaf).wanted = true;
  for (const int leaf : hot_leaves_) {
    if (!node(leaf).wanted) changed_.push_back(leaf);
  }
  for (const int leaf : next_hot_) {
    if (!node(leaf).hot) changed_.push_back(leaf);
    node(leaf).wanted = false;
  }
  const int hub = tree_.common_ancestor(next_hot_);
  for (const int leaf : changed_) follow(state, leaf);
  follow(state, hub);
  for (int h = 0; h < zone_.size(); ++h) {
    Place& p = place(zone_.slot(h));
    p.mean = p.read = zone_.mean(h);
    p.hot = none;
  }
  for (const int leaf : hot_leaves_) node(leaf).hot = false;
  for (const int leaf : next_hot_) node(leaf).hot = true;
  hot_leaves_.swap(next_hot_);

  tree_.move_hub(hub, way_);
  for (const int i : way_) node(i).is_stale = true;
  for (const int leaf : changed_) {
    for (int i = leaf; i != hub; i = tree_.towards(i)) node(i).is_stale = true;
    if (node(leaf).hot) continue;
    for_each_landmark(leaf, [&](int slot) { place(slot).leaves = count_leaves(state, slot); });
  }
  changed_.clear();
  return fill_zone(state);
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

/// The blocks that a leaf owns, but those of the window.
void CondensationTree::add_leaf_to_front(const InformationState& state, int leaf) {
  ++visit_;
  const auto mention = [&](int slot) {
    if (place(slot).visit == visit_) return;
    place(slot).visit = visit_;
    front_.mention(slot);
  };
  for_each_landmark(leaf, [&](int slot) {
    mention(slot);
    ++blocks_touched_;
    if (state.position(slot) < 0) front_.add(slot, slot, state.information(slot));
    state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
      ++blocks_touched_;
      const int leaf_of_other = place(other).leaf;
      if (leaf_of_other < leaf || (leaf_of_other == leaf && other < slot)) return;
      mention(other);
      front_.add(slot, other, Omega_so);
    });
  });
}

/// Sends the message of a node, after those that it depends on.
bool CondensationTree::send(const InformationState& state, int from) {
  bool done = true;
  tree_.for_each_source(from, [&](int source) {
    if (done && node(source).is_stale) done = send(state, source);
  });
  if (!done) return false;
  front_.begin();
  tree_.for_each_source(from, [&](int source) { front_.add(node(source).message); });
  if (tree_.is_leaf(from) && !node(from).hot) add_leaf_to_front(state, from);
  return condense(from);
}

/// Eliminates what is complete of the front.
bool CondensationTree::condense(int at) {
  overgrown_ = front_.size() > options_.most_in_front;
  if (overgrown_) return false;
  Condensed& message = node(at).message;
  const auto is_complete = [&](int slot, int leaves) {
    return !node(place(slot).leaf).hot && leaves == place(slot).leaves;
  };
  if (!front_.condense(is_complete, message)) return false;
  for (const int slot : message.eliminated) place(slot).eliminated_at = at;
  for (const Condensed::Mention& m : message.boundary) {
    const auto& mean = place(m.slot).mean;
    message.reference.insert(message.reference.end(), {mean.x(), mean.y()});
  }
  node(at).is_stale = false;
  blocks_touched_ += message.blocks();
  return true;
}

/// Brings together at the hub all messages and what the hot leaves own, and eliminates there whatever is not
/// active.
bool CondensationTree::fill_zone(const InformationState& state) {
  const int hub = tree_.hub();
  bool done = true;
  tree_.for_each_source(hub, [&](int source) {
    if (done && node(source).is_stale) done = send(state, source);
  });
  if (!done) return false;
  front_.begin();
  tree_.for_each_source(hub, [&](int source) { front_.add(node(source).message); });
  for (const int leaf : hot_leaves_) add_leaf_to_front(state, leaf);
  if (!condense(hub)) return false;
  zone_.load(node(hub).message);
  zone_places_.clear();
  for (int h = 0; h < zone_.size(); ++h) {
    Place& p = place(zone_.slot(h));
    p.hot = h;
    zone_.set_mean(h, p.mean);
    if (state.position(zone_.slot(h)) < 0) zone_places_.push_back(h);
  }
  zone_followed_at_ = ++epoch_;
  return zone_places_.empty() || zone_.eliminate(zone_places_);
}

}  // namespace seif
