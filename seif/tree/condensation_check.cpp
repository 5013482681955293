// What must hold of a condensation tree between updates.
#include <algorithm>
#include <optional>
#include <sstream>
#include <string>

#include "seif/tree/condensation_tree.hpp"

namespace seif {
namespace {

using Broken = std::optional<std::string>;

template <class... Parts>
Broken broken(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// Whether the message eliminates a variable, keeps it in its boundary, or ties it to a group.
bool takes_in(const Condensed& message, FrontVariable variable) {
  const auto is_it = [&](const auto& other) { return other.variable == variable; };
  return std::ranges::count(message.eliminated, variable) > 0 ||
         std::ranges::any_of(message.boundary, is_it) || std::ranges::any_of(message.tied, is_it);
}

/// How often the message eliminates or ties a variable.
std::ptrdiff_t times_settled(const Condensed& message, FrontVariable variable) {
  const auto is_it = [&](const Condensed::Tie& tie) { return tie.variable == variable; };
  return std::ranges::count(message.eliminated, variable) + std::ranges::count_if(message.tied, is_it);
}

int count_leaves(const CondensationRecords& records, int slot) {
  int leaves = 0;
  for (std::size_t i = 0; i < records.nodes.size(); ++i) {
    const auto is_it = [&](const Condensed::Member& m) { return m.variable == slot; };
    if (std::ranges::any_of(records.nodes[i].own.boundary, is_it)) ++leaves;
  }
  return leaves;
}

Broken broken_landmark(const CondensationRecords& records, const PlanMarking& marking, int slot) {
  const CondensedLandmark& p = records.landmark(slot);
  if (marking.is_changed(p.leaf)) return std::nullopt;  // until the zone has moved
  const bool is_hot = records.node(p.leaf).hot;
  if (is_hot != (p.zone_index != CondensationRecords::none))
    return broken("landmark ", slot, " of leaf ", p.leaf, " is at odds with it");
  if (is_hot) return std::nullopt;
  if (p.leaves != count_leaves(records, slot)) return broken("other leaves mention landmark ", slot);
  if (times_settled(records.sent(p.settled_at).message, slot) != 1)
    return broken("landmark ", slot, " is not settled at node ", p.settled_at);
  return std::nullopt;
}

Broken broken_message(const CondensationRecords& records, int i) {
  const Condensed& message = records.sent(i).message;
  if (records.node(i).hot && message.blocks() > 0) return broken("hot leaf ", i, " has a message");
  int next = records.receiver(i);
  while (next != CondensationRecords::none && records.sent(next).is_bare) next = records.receiver(next);
  for (const Condensed::Member& m : message.boundary) {
    if (next != CondensationRecords::none && !takes_in(records.sent(next).message, m.variable))
      return broken("node ", next, " does not take in ", m.variable, " of node ", i);
  }
  for (const FrontVariable v : message.eliminated) {
    if (records.settled_at(v) != i)
      return broken("variable ", v, " is eliminated at node ", i, ", and settled elsewhere");
  }
  return std::nullopt;
}

Broken broken_group(const CondensationRecords& records, const PlanMarking& marking, int group, int i) {
  const LeafTree& tree = records.tree;
  const Condensed& message = records.sent(i).message;
  const auto is_used_in = [&](int leaf) { return tree.is_within(leaf, group) && !marking.is_changed(leaf); };
  if (std::ranges::any_of(records.hot_leaves, is_used_in))
    return broken("group ", group, " in node ", i, " is hot");
  if (records.node(group).group.fronts <= 0) return broken("group ", group, " is counted wrong");
  const auto is_beside = [&](FrontVariable v) {
    return records.node_of(v) != group && tree.is_within(records.node_of(v), group);
  };
  if (std::ranges::any_of(message.eliminated, is_beside) ||
      std::ranges::any_of(message.boundary, is_beside, &Condensed::Member::variable))
    return broken("node ", i, " has landmarks beside their group ", group);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> CondensationTree::broken_invariant(const InformationState& state) const {
  for (int h = 0; h < zone_.size(); ++h) {
    const int slot = zone_.slot(h);
    if (records_.landmark(slot).zone_index != h)
      return broken("landmark ", slot, " has another index in the zone");
    if (zone_.is_active(h) != (state.position(slot) >= 0)) return broken("zone and window differ at ", slot);
  }
  for (int slot = 0; slot < state.landmark_count(); ++slot) {
    if (Broken wrong = broken_landmark(records_, marking_, slot)) return wrong;
  }
  for (int i = 0; i < records_.tree.size(); ++i) {
    if (Broken wrong = broken_message(records_, i)) return wrong;
    for (const int group : records_.sent(i).groups) {
      if (Broken wrong = broken_group(records_, marking_, group, i)) return wrong;
    }
  }
  return std::nullopt;
}

}  // namespace seif
