// Which leaves are to be hot next, and which messages have to be sent anew for that.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seif/tree/condensation_tree.hpp"

namespace seif {

Eigen::Vector2d CondensationTree::zone_middle(const Pose2& pose) const {
  return pose * Eigen::Vector2d(options_.zone_before * view_, 0.0);
}

void CondensationTree::note_homes(const InformationState& state) {
  homes_.begin();
  for (int p = 0; p < state.active_count(); ++p)
    homes_.add(landmark(state.active(p)).home, state.mean(state.active(p)));
  homes_.finish(0.5 * view_);
}

void CondensationTree::note_travel(const InformationState& state) {
  constexpr double kept = 0.95;  // of it, at an update that goes less far
  note_homes(state);
  const Eigen::Vector2d now = zone_middle(state.pose());
  if (scan_ > 1) travel_ = std::max((now - last_middle_).norm(), kept * travel_);
  last_middle_ = now;
}

/// In how many slices a plan is made ready: a third of the updates in which the robot comes to see what has
/// called for it. So most updates work on none, in maps of any size.
int CondensationTree::slices() const {
  constexpr double fewest_slices = 4.0;
  constexpr double most_slices = 64.0;
  const double updates = options_.zone_before * view_ / std::max(travel_, 1e-9);
  return static_cast<int>(std::clamp(updates / 3.0, fewest_slices, most_slices));
}

/// False if the zone may stay as it is. Otherwise plan_.hot_leaves are those of the landmarks that are active
/// or seen, those near the robot, and those last used that still have room beside them.
bool CondensationTree::choose_hot_leaves(const InformationState& state, std::span<const int> slots) {
  std::vector<int>& chosen = plan_.hot_leaves;
  chosen.clear();
  int landmarks = 0;
  const auto want = [&](int leaf) {
    if (node(leaf).wanted || leaf == held_leaf_) return;
    node(leaf).wanted = true;
    landmarks += node(leaf).landmarks;
    chosen.push_back(leaf);
  };
  for (int p = 0; p < state.active_count(); ++p) want(landmark(state.active(p)).leaf);
  for (const int slot : slots) want(landmark(slot).leaf);
  for (const int slot : wanted_) want(landmark(slot).leaf);
  const auto want_near = [&](double views) {
    if (options_.most_blocks == 0) return;  // what is wanted comes at once
    // Leaves stay where their landmarks first were, however a closure has bent the map since.
    const Eigen::Vector2d middle = zone_middle(state.pose());
    tree_.for_each_leaf_near(middle + homes_.offset(), views * view_, want);
    if (const auto& other = homes_.other_offset())
      tree_.for_each_leaf_near(middle + *other, views * view_, want);
  };
  want_near(options_.look_ahead);
  const bool all_hot = std::ranges::all_of(chosen, [&](int leaf) { return node(leaf).hot; });
  want_near(options_.zone_ahead);
  const bool may_stay = all_hot && zone_.size() <= std::max(options_.most_hot, landmarks + landmarks / 2);
  if (!may_stay) add_last_used(landmarks);
  for (const int leaf : chosen) node(leaf).wanted = false;
  return !may_stay && !(all_hot && chosen.size() == hot_leaves_.size());
}

/// As long as there is room.
void CondensationTree::add_last_used(int landmarks) {
  std::ranges::sort(hot_leaves_, [&](int a, int b) {
    return node(a).used != node(b).used ? node(a).used > node(b).used : a > b;
  });
  for (const int leaf : hot_leaves_) {
    if (node(leaf).wanted) continue;
    landmarks += node(leaf).landmarks;
    if (landmarks > options_.most_hot) break;
    node(leaf).wanted = true;
    plan_.hot_leaves.push_back(leaf);
  }
}

/// For plan_.hot_leaves.
void CondensationTree::begin_plan(const InformationState& state) { prepare_plan(state, mark_plan()); }

/// Whatever was planned before has been done. All nodes send anew, without any group.
void CondensationTree::begin_plan_of_all(const InformationState& state) {
  plan_.hot_leaves = hot_leaves_;
  const int hub = mark_plan();
  for (int at = 0; at < tree_.size(); ++at) {
    if (at != held_leaf_) mark_stale(at);
  }
  prepare_plan(state, hub);
}

/// Only messages that then say something else, or go elsewhere, are sent anew: those on the way from a leaf
/// that becomes hot or cold to the hub, from the old hub to the new one, and with groups that will be too
/// near. Returns the new hub.
int CondensationTree::mark_plan() {
  plan_.is_running = true;
  ++plan_.number;
  plan_.stale.clear();
  plan_.begun.clear();
  mark_changed_leaves();
  const int hub = tree_.common_ancestor(plan_.hot_leaves);
  for (const int leaf : changed_) mark_stale(leaf);
  mark_stale(hub);
  mark_expired(tree_.hub());
  tree_.plan_hub(hub);
  return hub;
}

void CondensationTree::prepare_plan(const InformationState& state, int hub) {
  for (const int at : plan_.stale) {
    note_groups(at);
    tree_.for_each_neighbour(at, [&](int other) { note_groups(other); });
  }
  plan_.order.clear();
  plan_.ready = 0;
  put_in_order(hub);
  std::int64_t as_before = 0;  // what the messages that go have cost
  for (const int at : plan_.order) as_before += sent(at).message.blocks();
  const bool in_slices = options_.most_blocks > 0;
  plan_.most_blocks = in_slices ? std::max<std::int64_t>(options_.most_blocks, as_before / slices()) : 0;
  while (plan_.messages.size() < plan_.order.size()) plan_.messages.emplace_back();
  note_places(state, hub);
}

void CondensationTree::put_in_order(int at) {
  tree_.for_each_planned_source(at, [&](int source) {
    if (is_stale(source)) put_in_order(source);
  });
  node(at).planned = static_cast<int>(plan_.order.size());
  plan_.order.push_back(at);
}

/// What a node will have sent once the zone has moved.
const SentMessage& CondensationTree::next_of(int at) const {
  return is_stale(at) ? plan_.messages[static_cast<std::size_t>(node(at).planned)] : node(at).sent;
}

void CondensationTree::mark_changed_leaves() {
  for (const int leaf : hot_leaves_) node(leaf).next_hot = false;
  for (const int leaf : plan_.hot_leaves) node(leaf).next_hot = true;
  for (const int leaf : hot_leaves_) {
    if (!node(leaf).next_hot) changed_.push_back(leaf);
  }
  for (const int leaf : plan_.hot_leaves) {
    if (!node(leaf).hot) changed_.push_back(leaf);
  }
}

/// From a node to the hub as it still is.
void CondensationTree::mark_stale(int at) {
  for (int i = at; i != none; i = tree_.towards(i)) {
    if (is_stale(i)) break;
    node(i).stale_in = plan_.number;
    plan_.stale.push_back(i);
  }
}

/// Nodes with a group in their fronts that the next zone is too near to, and what depends on them.
void CondensationTree::mark_expired(int at) {
  const SentMessage& now = sent(at);
  const bool changes = is_stale(at);
  const auto enters = [&](int leaf) { return now.reach.intersects(tree_.box(leaf)); };
  if (!changes && std::ranges::none_of(plan_.hot_leaves, enters)) return;
  const auto is_too_near = [&](int g) { return distance_ratio(g) < 0.5 * options_.grain; };
  if (!changes && std::ranges::any_of(now.groups, is_too_near)) mark_stale(at);
  tree_.for_each_source(at, [&](int source) { mark_expired(source); });
}

/// Those that a node has heard or told of: their means will be known when the zone moves.
void CondensationTree::note_groups(int at) {
  if (is_stale(at)) {
    for (const int g : sent(at).groups) node(g).group.known_in = plan_.number;
  }
  for (const Condensed::Member& m : sent(at).message.boundary) {
    if (is_group(m.variable)) node(~m.variable).group.known_in = plan_.number;
  }
}

}  // namespace seif
