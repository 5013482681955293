// The messages of a plan, made ready: each node's front filled and condensed. What they hold of the residual
// comes when the zone moves (condensation_switching.cpp).
#include <cstdint>
#include <limits>

#include "seif/tree/condensation_tree.hpp"

namespace seif {

/// At least one message, and as many as will not take more blocks, if each takes what the one before it took.
/// False if a matrix is not positive definite.
bool CondensationTree::make_ready(std::int64_t most_blocks) {
  const std::int64_t until = most_blocks > 0 ? blocks_touched_ + most_blocks  //
                                             : std::numeric_limits<std::int64_t>::max();
  const std::size_t before = plan_.ready;
  for (; plan_.ready < plan_.order.size(); ++plan_.ready) {
    const int at = plan_.order[plan_.ready];
    const std::int64_t expected = sent(at).message.blocks();
    if (plan_.ready > before && expected > until - blocks_touched_) break;
    if (!send(at)) return false;
  }
  return true;
}

bool CondensationTree::send(int from) {
  SentMessage& next = plan_.messages[plan_.ready];
  const bool is_hub = tree_.planned_towards(from) == none;
  next.is_bare = !is_hub && tree_.leaves(from) <= most_bare;
  if (next.is_bare) {
    next.message.clear();
    if (tree_.is_leaf(from) && !node(from).next_hot) {
      for (Condensed::Member& m : node(from).own.boundary)
        m.balance = landmark(m.variable).leaf == from ? 1 - landmark(m.variable).leaves : 1;
    }
    next.groups.clear();
    note_reach(from, next);
    return true;
  }
  front_.begin();
  gather(from);
  if (is_hub) {
    for (const int leaf : plan_.hot_leaves) add_element(leaf);
    if (held_leaf_ != none) add_element(held_leaf_);
  }
  return condense(from, next);
}

/// Brings to the front of a node what its sources send, or what comes through them.
void CondensationTree::gather(int at) {
  tree_.for_each_planned_source(at, [&](int source) {
    const SentMessage& next = next_of(source);
    if (tree_.is_leaf(source)) {
      if (!node(source).next_hot) add_element(source);
    } else if (next.is_bare) {
      gather(source);
    } else {
      add_message(next.message, is_stale(source));
    }
  });
}

/// One that is new is where the plan has it.
void CondensationTree::add_message(const Condensed& message, bool is_new) {
  if (is_new || !options_.turns) {
    front_.add(message);
  } else {
    list_places(message);
    front_.add(message, places_);
  }
}

void CondensationTree::add_element(int leaf) {
  add_message(node(leaf).own, false);
  blocks_touched_ += node(leaf).own.blocks();
}

/// Whether all blocks of a variable are in the front of a node. At the hub those of all cold ones are.
bool CondensationTree::is_complete(int at, FrontVariable v, int balance) const {
  const bool is_cold = is_group(v) || !node(landmark(v).leaf).next_hot;
  const int next = tree_.planned_towards(at);
  if (next == none || !is_cold) return is_cold;
  if (balance != 0) return false;
  if (!is_group(v)) return true;
  const bool comes_from_below = next == tree_.parent(at);
  return comes_from_below ? tree_.is_within(~v, at)
                          : !tree_.is_within(~v, next) && !tree_.is_within(next, ~v);
}

/// Eliminates what is complete of the front.
bool CondensationTree::condense(int at, SentMessage& next) {
  tie_front(at, next);
  const auto complete = [&](FrontVariable v, int balance) { return is_complete(at, v, balance); };
  if (!front_.condense(complete, next.message)) return false;
  blocks_touched_ += next.message.blocks();
  return true;
}

}  // namespace seif
