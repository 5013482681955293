#include "seif/tree/plan_marking.hpp"

#include <algorithm>

namespace seif {

bool PlanMarking::is_changed(int leaf) const {
  return std::ranges::find(changed_, leaf) != changed_.end() || std::ranges::find(news_, leaf) != news_.end();
}

void PlanMarking::begin() {
  reset();
  find_path();
  mark_changed();
  mark_news();
  mark_stale(0);
  mark_expired(0);
  finish();
}

void PlanMarking::begin_all() {
  plan_.hot_leaves = records_.hot_leaves;
  reset();
  find_path();
  for (int at = CondensationRecords::most_rings; at < records_.tree.size(); ++at) {
    if (at != records_.held_leaf) mark_stale(at);
  }
  mark_stale(std::max(records_.top_ring, plan_.top_ring));
  finish();
}

void PlanMarking::reset() {
  plan_.is_running = true;
  ++plan_.number;
  plan_.updates = 0;
  plan_.is_urgent = plan_.has_news = false;
  plan_.read = plan_.carried_so_far = plan_.ready = 0;
  plan_.stale.clear();
}

/// The next one, and its rings.
void PlanMarking::find_path() {
  for (const int leaf : records_.hot_leaves) records_.node(leaf).next_hot = false;
  for (const int leaf : plan_.hot_leaves) records_.node(leaf).next_hot = true;
  for (const int n : records_.path) records_.node(n).next_on_path = false;
  plan_.path.clear();
  plan_.top_ring = 0;
  for (const int leaf : plan_.hot_leaves) {
    for (int n = leaf; n != none && !records_.node(n).next_on_path; n = records_.tree.parent(n)) {
      CondensationNode& node = records_.node(n);
      node.next_on_path = true;
      node.next_ring = CondensationRecords::ring_of(records_.tree.leaves(n));
      plan_.top_ring = std::max(plan_.top_ring, node.next_ring);
      plan_.path.push_back(n);
    }
  }
}

/// Nodes that come to the path, leave it, or change the ring; and new leaves.
void PlanMarking::mark_changed() {
  for (const int n : records_.path) {
    const CondensationNode& node = records_.node(n);
    if (node.next_on_path && node.next_ring == node.ring) continue;
    mark_stale(node.ring);
    mark_stale(node.next_on_path ? node.next_ring : n);
  }
  for (const int n : plan_.path) {
    if (!records_.node(n).on_path) mark_stale(n);
  }
  for (const int leaf : changed_) mark_stale(leaf);
}

/// No group of a node above may begin or stay.
void PlanMarking::mark_news() {
  std::ranges::sort(news_);
  news_.erase(std::ranges::unique(news_).begin(), news_.end());
  for (const int leaf : news_) {
    mark_stale(leaf);
    for (int n = leaf; n != none && records_.node(n).distance_known_in != plan_.number;
         n = records_.tree.parent(n)) {
      records_.node(n).distance_known_in = plan_.number;
      records_.node(n).distance_ratio = 0.0;
    }
  }
}

void PlanMarking::finish() {
  for (const int at : plan_.stale) {
    records_.sent(at).message.S.clear();  // nobody adds it up any more
    note_groups(at);
    records_.for_each_source(at, [&](int source) { note_groups(source); });
  }
  list_readings();
  plan_.carried = plan_.hot_leaves;
  if (records_.held_leaf != none) plan_.carried.push_back(records_.held_leaf);
  put_in_order();
  while (plan_.messages.size() < plan_.order.size()) plan_.messages.emplace_back();
}

/// By the next path. A node on it sends nothing; what comes to it goes to its ring.
int PlanMarking::next_receiver(int at) const {
  if (CondensationRecords::is_ring(at)) return at - 1;
  if (records_.node(at).next_on_path) return records_.node(at).next_ring;
  const int above = records_.tree.parent(at);
  return above != none && records_.node(above).next_on_path ? records_.node(above).next_ring : above;
}

/// With all that depends on it, before and then.
void PlanMarking::mark_stale(int at) {
  if (is_stale(at)) return;
  records_.node(at).stale_in = plan_.number;
  plan_.stale.push_back(at);
  if (const int next = next_receiver(at); next != none) mark_stale(next);
  if (records_.node(at).on_path) return;
  if (const int now = records_.receiver(at); now != none) mark_stale(now);
}

/// Nodes and rings with a group in their fronts that the next zone is too near to.
void PlanMarking::mark_expired(int at) {
  const SentMessage& now = records_.sent(at);
  const bool changes = is_stale(at);
  const auto enters = [&](int leaf) { return now.reach.intersects(records_.tree.box(leaf)); };
  if (!changes && std::ranges::none_of(plan_.hot_leaves, enters) && std::ranges::none_of(news_, enters))
    return;
  if (!changes && std::ranges::any_of(now.groups, [&](int g) { return grouping_.is_expired(g); }))
    mark_stale(at);
  records_.for_each_source(at, [&](int source) { mark_expired(source); });
}

/// Those that it has heard or told of: their means will be known.
void PlanMarking::note_groups(int at) {
  if (is_stale(at)) {
    for (const int g : records_.sent(at).groups) records_.node(g).group.known_in = plan_.number;
  }
  for (const Condensed::Member& m : records_.sent(at).message.boundary) {
    if (is_group(m.variable)) records_.node(~m.variable).group.known_in = plan_.number;
  }
}

/// Each after the one that it has sent to.
void PlanMarking::list_readings() {
  plan_.readings.clear();
  for (int ring = 0; ring <= records_.top_ring && is_stale(ring); ++ring) {
    plan_.readings.push_back(ring);
    records_.for_each_source(ring, [&](int source) {
      if (!CondensationRecords::is_ring(source)) list_readings_below(source);
    });
  }
}

void PlanMarking::list_readings_below(int at) {
  if (!is_stale(at)) return;
  plan_.readings.push_back(at);
  records_.for_each_source(at, [&](int source) { list_readings_below(source); });
}

/// Each after those that send to it. Nodes that come to the path only forget.
void PlanMarking::put_in_order() {
  plan_.order.clear();
  const auto put = [&](int at) {
    records_.node(at).planned = static_cast<int>(plan_.order.size());
    plan_.order.push_back(at);
  };
  for (const int n : plan_.path) {
    if (is_stale(n)) put(n);
  }
  for (int ring = std::max(records_.top_ring, plan_.top_ring); ring >= 0; --ring) {
    if (!is_stale(ring)) continue;
    for (const int n : plan_.path) {
      if (records_.node(n).next_ring != ring) continue;
      for (const int child : records_.tree.children(n)) {
        if (child != none && !records_.node(child).next_on_path && is_stale(child)) put_in_order(child);
      }
    }
    put(ring);
  }
}

void PlanMarking::put_in_order(int at) {
  for (const int child : records_.tree.children(at)) {
    if (child != none && is_stale(child)) put_in_order(child);
  }
  records_.node(at).planned = static_cast<int>(plan_.order.size());
  plan_.order.push_back(at);
}

}  // namespace seif
