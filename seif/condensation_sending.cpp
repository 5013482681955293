// What a node sends: its front filled, condensed, and what is left of the residual.
#include "seif/condensation_tree.hpp"

namespace seif {

/// The blocks that a leaf owns, but those of the window.
void CondensationTree::add_leaf_to_front(const InformationState& state, int leaf) {
  ++visit_;
  const auto mention = [&](int slot) {
    if (place(slot).visit == visit_) return;
    place(slot).visit = visit_;
    front_.mention(slot, place(slot).leaf == leaf ? 1 - place(slot).leaves : 1);
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
  const bool is_cold_leaf = tree_.is_leaf(from) && !node(from).hot;
  if (is_cold_leaf) add_leaf_to_front(state, from);
  if (!condense(state, from)) return false;
  condense_residual(from);
  return true;
}

bool CondensationTree::is_complete(int at, FrontVariable v, int balance) const {
  const bool is_cold = is_group(v) || !node(place(v).leaf).hot;
  const int next = tree_.towards(at);
  if (next == none || !is_cold) return is_cold;
  if (balance != 0) return false;
  if (!is_group(v)) return true;
  const bool comes_from_below = next == tree_.parent(at);
  return comes_from_below ? tree_.is_within(~v, at)
                          : !tree_.is_within(~v, next) && !tree_.is_within(next, ~v);
}

/// Eliminates what is complete of the front.
bool CondensationTree::condense(const InformationState& state, int at) {
  tie_front(state, at);
  Condensed& message = node(at).message;
  const auto complete = [&](FrontVariable v, int balance) { return is_complete(at, v, balance); };
  if (!front_.condense(complete, message)) return false;
  for (const FrontVariable v : message.eliminated) settle(v, at);
  for (Condensed::Tie& tie : message.tied) {
    settle(tie.variable, at);
    as_read(tie.variable, tie.reference.data());
  }
  message.reference.resize(static_cast<std::size_t>(message.b));
  double* reference = message.reference.data();
  for (const Condensed::Member& m : message.boundary) {
    as_read(m.variable, reference);
    reference += freedom(m.variable);
  }
  node(at).is_stale = node(at).is_new = false;
  blocks_touched_ += message.blocks();
  return true;
}

void CondensationTree::settle(FrontVariable v, int at) {
  if (is_group(v)) {
    LandmarkGroup& group = node(~v).group;
    group.settled_at = at;
    group.mean = group.read;
  } else {
    place(v).settled_at = at;
    place(v).mean = place(v).read;
  }
}

void CondensationTree::condense_residual(int at) {
  Condensed& message = node(at).message;
  front_.begin_residual(message);
  tree_.for_each_source(at, [&](int source) {
    const Condensed& part = node(source).message;
    front_.add_residual(part, residual_of(part));
  });
  const bool is_hub = tree_.towards(at) == none;
  if (is_hub || tree_.is_leaf(at)) {
    const auto add_loose = [&](FrontVariable v) {
      if (is_group(v)) return;
      front_.add_residual(v, place(v).loose);
      if (!is_hub) place(v).loose.setZero();
    };
    for (const FrontVariable v : message.eliminated) add_loose(v);
    for (const Condensed::Member& m : message.boundary) add_loose(m.variable);
    for (const Condensed::Tie& tie : message.tied) add_loose(tie.variable);
  }
  front_.condense_residual(message);
}

/// Brings together at the hub all messages and what the hot leaves own, and eliminates there whatever is not
/// active.
bool CondensationTree::fill_zone(InformationState& state) {
  const int hub = tree_.hub();
  bool done = true;
  tree_.for_each_source(hub, [&](int source) {
    if (done && node(source).is_stale) done = send(state, source);
  });
  if (!done) return false;
  front_.begin();
  tree_.for_each_source(hub, [&](int source) { front_.add(node(source).message); });
  for (const int leaf : hot_leaves_) add_leaf_to_front(state, leaf);
  if (!condense(state, hub)) return false;
  condense_residual(hub);
  const Condensed& message = node(hub).message;
  zone_.load(message);
  zone_places_.clear();
  for (int h = 0; h < zone_.size(); ++h) {
    Place& p = place(zone_.slot(h));
    p.hot = h;
    zone_.set_mean(h, p.read);
    if (state.position(zone_.slot(h)) < 0) zone_places_.push_back(h);
  }
  zone_followed_at_ = ++epoch_;
  if (!zone_places_.empty() && !zone_.eliminate(zone_places_)) return false;
  pull_zone(state, Eigen::Map<const Eigen::VectorXd>(message.s.data(), message.b));
  return true;
}

/// What is left of the residual s of the zone, now that nearer groups have been untied: those eliminated
/// move, and the window gets it into its own.
void CondensationTree::pull_zone(InformationState& state, const Eigen::Ref<const Eigen::VectorXd>& s) {
  for (int h = 0; h < zone_.size(); ++h) {
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
    for (const int p : zone_places_) pull -= zone_.block(h, p) * s.segment<2>(2 * p);
    const int position = state.position(zone_.slot(h));
    if (position < 0) {
      zone_.set_mean(h, zone_.mean(h) + pull);
    } else {
      state.r().segment<2>(InformationState::row_of(position)) = s.segment<2>(2 * h) + pull;
    }
  }
}

}  // namespace seif
