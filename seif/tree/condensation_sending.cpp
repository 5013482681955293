// The messages of a plan, made ready: each node's front filled and condensed. What they hold of the residual
// comes when the zone moves (condensation_switching.cpp).
#include <cstdint>
#include <limits>

#include "seif/tree/condensation_tree.hpp"

namespace seif {

/// At least one message, and as many as will not take more blocks, if each takes what the one before it took.
/// False if a matrix is not positive definite.
bool CondensationTree::make_ready(const InformationState& state, std::int64_t most_blocks) {
  const std::int64_t until = most_blocks > 0 ? blocks_touched_ + most_blocks  //
                                             : std::numeric_limits<std::int64_t>::max();
  const std::size_t before = plan_.ready;
  for (; plan_.ready < plan_.order.size(); ++plan_.ready) {
    const int at = plan_.order[plan_.ready];
    const std::int64_t expected = sent(at).message.blocks();
    if (plan_.ready > before && expected > until - blocks_touched_) break;
    if (!send(state, at)) return false;
  }
  return true;
}

bool CondensationTree::send(const InformationState& state, int from) {
  SentMessage& next = plan_.messages[plan_.ready];
  const bool is_hub = tree_.planned_towards(from) == none;
  next.is_bare = !is_hub && tree_.leaves(from) <= most_bare;
  if (next.is_bare) {
    next.message.clear();
    if (tree_.is_leaf(from) && !node(from).next_hot) list_leaf(state, from, next.message);
    next.groups.clear();
    note_reach(from, next);
    return true;
  }
  front_.begin();
  gather(from);
  if (is_hub) {
    list_links(state);
    front_.add(links_);
  }
  return condense(state, from, next);
}

/// Brings to the front of a node what its sources send, or what comes through them.
void CondensationTree::gather(int at) {
  tree_.for_each_planned_source(at, [&](int source) {
    const SentMessage& next = next_of(source);
    if (next.is_bare && !tree_.is_leaf(source)) {
      gather(source);
    } else {
      front_.add(next.message);
      if (next.is_bare) blocks_touched_ += next.message.blocks();
    }
  });
}

/// The place of a landmark in the boundary of a part that is being listed.
int CondensationTree::listed(Condensed& part, int slot, int balance) {
  CondensedLandmark& p = landmark(slot);
  if (p.visit != visit_) {
    p.visit = visit_;
    p.row = static_cast<int>(part.boundary.size());
    part.boundary.push_back({slot, balance});
    part.b += freedom(slot);
  }
  return p.row;
}

/// The blocks that a leaf owns.
void CondensationTree::list_leaf(const InformationState& state, int leaf, Condensed& part) {
  ++visit_;
  const auto listed_at = [&](int slot) {
    return listed(part, slot, landmark(slot).leaf == leaf ? 1 - landmark(slot).leaves : 1);
  };
  for_each_owned_block(state, leaf, [&](int slot, int other, const auto& Omega_so) {
    ++blocks_touched_;
    const int i = listed_at(slot);
    part.S_blocks.push_back({.i = i, .j = listed_at(other), .Omega_ij = Omega_so});
  });
}

/// Of the blocks that hot leaves own, those with cold landmarks: nothing else comes between these and the
/// zone.
void CondensationTree::list_links(const InformationState& state) {
  ++visit_;
  links_.clear();
  for (const int leaf : plan_.hot_leaves) {
    for_each_landmark(leaf, [&](int slot) {
      state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
        ++blocks_touched_;
        const int leaf_of_other = landmark(other).leaf;
        if (leaf_of_other < leaf || node(leaf_of_other).next_hot) return;
        const int i = listed(links_, slot, 0);
        links_.S_blocks.push_back({.i = i, .j = listed(links_, other, 0), .Omega_ij = Omega_so});
      });
    });
  }
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
bool CondensationTree::condense(const InformationState& state, int at, SentMessage& next) {
  tie_front(state, at, next);
  const auto complete = [&](FrontVariable v, int balance) { return is_complete(at, v, balance); };
  if (!front_.condense(complete, next.message)) return false;
  blocks_touched_ += next.message.blocks();
  return true;
}

}  // namespace seif
