#include "seif/tree/plan_marking.hpp"

#include <algorithm>

namespace seif {

bool PlanMarking::is_changed(int leaf) const { return std::ranges::find(changed_, leaf) != changed_.end(); }

void PlanMarking::begin_all() {
  plan_.hot_leaves = records_.hot_leaves;
  const int hub = mark();
  for (int at = 0; at < records_.tree.size(); ++at) {
    if (at != records_.held_leaf) mark_stale(at);
  }
  finish(hub);
}

/// Returns the new hub.
int PlanMarking::mark() {
  plan_.is_running = true;
  ++plan_.number;
  plan_.updates = 0;
  plan_.read = plan_.carried_so_far = plan_.ready = 0;
  plan_.stale.clear();
  mark_changed_leaves();
  const int hub = records_.tree.common_ancestor(plan_.hot_leaves);
  for (const int leaf : changed_) mark_stale(leaf);
  mark_stale(hub);
  mark_expired(records_.tree.hub());
  records_.tree.plan_hub(hub);
  return hub;
}

void PlanMarking::finish(int hub) {
  for (const int at : plan_.stale) {
    note_groups(at);
    records_.tree.for_each_neighbour(at, [&](int other) { note_groups(other); });
  }
  plan_.readings.clear();
  list_readings(records_.tree.hub());
  plan_.carried = plan_.hot_leaves;
  if (records_.held_leaf != CondensationRecords::none) plan_.carried.push_back(records_.held_leaf);
  plan_.order.clear();
  put_in_order(hub);
  while (plan_.messages.size() < plan_.order.size()) plan_.messages.emplace_back();
}

void PlanMarking::mark_changed_leaves() {
  for (const int leaf : records_.hot_leaves) records_.node(leaf).next_hot = false;
  for (const int leaf : plan_.hot_leaves) records_.node(leaf).next_hot = true;
  for (const int leaf : records_.hot_leaves) {
    if (!records_.node(leaf).next_hot) changed_.push_back(leaf);
  }
  for (const int leaf : plan_.hot_leaves) {
    if (!records_.node(leaf).hot) changed_.push_back(leaf);
  }
}

/// From a node to the hub as it still is.
void PlanMarking::mark_stale(int at) {
  for (int i = at; i != CondensationRecords::none; i = records_.tree.towards(i)) {
    if (is_stale(i)) break;
    records_.node(i).stale_in = plan_.number;
    plan_.stale.push_back(i);
  }
}

/// Nodes with a group in their fronts that the next zone is too near to, and what depends on them.
void PlanMarking::mark_expired(int at) {
  const SentMessage& now = records_.sent(at);
  const bool changes = is_stale(at);
  const auto enters = [&](int leaf) { return now.reach.intersects(records_.tree.box(leaf)); };
  if (!changes && std::ranges::none_of(plan_.hot_leaves, enters)) return;
  if (!changes && std::ranges::any_of(now.groups, [&](int g) { return grouping_.is_expired(g); })) mark_stale(at);
  records_.tree.for_each_source(at, [&](int source) { mark_expired(source); });
}

/// Those that a node has heard or told of: their means will be known.
void PlanMarking::note_groups(int at) {
  if (is_stale(at)) {
    for (const int g : records_.sent(at).groups) records_.node(g).group.known_in = plan_.number;
  }
  for (const Condensed::Member& m : records_.sent(at).message.boundary) {
    if (is_group(m.variable)) records_.node(~m.variable).group.known_in = plan_.number;
  }
}

/// The stale nodes, each after the one that it sends to.
void PlanMarking::list_readings(int at) {
  plan_.readings.push_back(at);
  records_.tree.for_each_source(at, [&](int source) {
    if (is_stale(source)) list_readings(source);
  });
}

void PlanMarking::put_in_order(int at) {
  records_.tree.for_each_planned_source(at, [&](int source) {
    if (is_stale(source)) put_in_order(source);
  });
  records_.node(at).planned = static_cast<int>(plan_.order.size());
  plan_.order.push_back(at);
}

}  // namespace seif
