// What must hold of a condensation tree between updates.
#include <algorithm>
#include <sstream>

#include "seif/condensation_tree.hpp"

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
    const std::vector<int>& eliminated = node(p.eliminated_at).message.eliminated;
    if (std::ranges::count(eliminated, slot) != 1)
      return broken("landmark ", slot, " was not eliminated once");
  }
  std::size_t eliminated = 0;
  std::size_t cold = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) cold += places_[i].hot == none ? 1U : 0U;
  for (int i = 0; i < tree_.size(); ++i) {
    const Condensed& message = node(i).message;
    eliminated += message.eliminated.size();
    if (node(i).hot && i != tree_.hub() && message.blocks() > 0)
      return broken("hot leaf ", i, " has a message");
    for (const Condensed::Mention& m : message.boundary) {
      int next = tree_.towards(i);
      while (next != none && next != place(m.slot).eliminated_at) next = tree_.towards(next);
      if (place(m.slot).hot == none && next == none) {
        return broken("landmark ", m.slot, " is not eliminated between node ", i, " and the hub");
      }
    }
  }
  if (eliminated != cold) return broken(eliminated, " landmarks are eliminated, ", cold, " are cold");
  return std::nullopt;
}

}  // namespace seif
