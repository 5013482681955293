// What must hold of a condensation tree between updates.
#include <algorithm>
#include <sstream>

#include "seif/tree/condensation_tree.hpp"

namespace seif {

std::optional<std::string> CondensationTree::broken_invariant(const InformationState& state) const {
  const auto broken = [](auto... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return std::optional(text.str());
  };
  for (int h = 0; h < zone_.size(); ++h) {
    const int slot = zone_.slot(h);
    if (place(slot).hot != h) return broken("landmark ", slot, " does not know its place in the zone");
    if (zone_.is_active(h) != (state.position(slot) >= 0)) return broken("zone and window differ at ", slot);
  }
  for (int slot = 0; slot < state.landmark_count(); ++slot) {
    const Place& p = place(slot);
    const bool is_hot = node(p.leaf).hot;
    if (is_hot != (p.hot != none))
      return broken("landmark ", slot, " of leaf ", p.leaf, " is at odds with it");
    if (is_hot) continue;
    if (p.leaves != count_leaves(state, slot)) return broken("other leaves mention landmark ", slot);
    const Condensed& message = sent(p.settled_at).message;
    const auto is_it = [&](const Condensed::Tie& tie) { return tie.variable == slot; };
    if (std::ranges::count(message.eliminated, slot) + std::ranges::count_if(message.tied, is_it) != 1)
      return broken("landmark ", slot, " is not settled at node ", p.settled_at);
  }
  for (int i = 0; i < tree_.size(); ++i) {
    const Condensed& message = sent(i).message;
    if (node(i).hot && i != tree_.hub() && message.blocks() > 0)
      return broken("hot leaf ", i, " has a message");
    int next = tree_.towards(i);
    while (next != none && sent(next).is_bare) next = tree_.towards(next);
    for (const Condensed::Member& m : message.boundary) {
      if (next == none) continue;
      const Condensed& later = sent(next).message;
      const auto is_it = [&](const auto& other) { return other.variable == m.variable; };
      if (!std::ranges::count(later.eliminated, m.variable) && std::ranges::none_of(later.boundary, is_it) &&
          std::ranges::none_of(later.tied, is_it)) {
        return broken("node ", next, " does not take in ", m.variable, " of node ", i);
      }
    }
    for (const FrontVariable v : message.eliminated) {
      if (settled_at(v) != i)
        return broken("variable ", v, " is eliminated at node ", i, ", and settled elsewhere");
    }
    for (const int g : sent(i).groups) {
      const auto inside = [&](int leaf) { return tree_.is_within(leaf, g); };
      const auto used_in = [&](int leaf) {
        return inside(leaf) && std::ranges::find(changed_, leaf) == changed_.end();
      };
      if (std::ranges::any_of(hot_leaves_, used_in)) return broken("group ", g, " in node ", i, " is hot");
      if (node(g).group.fronts <= 0) return broken("group ", g, " is counted wrong");
      const auto is_beside = [&](FrontVariable v) {
        return node_of(v) != g && tree_.is_within(node_of(v), g);
      };
      if (std::ranges::any_of(message.eliminated, is_beside) ||
          std::ranges::any_of(message.boundary, is_beside, &Condensed::Member::variable))
        return broken("node ", i, " has landmarks beside their group ", g);
    }
  }
  return std::nullopt;
}

}  // namespace seif
