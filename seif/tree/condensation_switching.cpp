// The zone moves: the messages of a plan take the places of those before, once they tell of the residual from
// where the means are. That is the work of an update's end; the zone moves as the next one begins, with the
// landmarks' means as they were left.
#include <algorithm>

#include "seif/tree/condensation_tree.hpp"

namespace seif {

void CondensationTree::end_update(const InformationState& state) {
  const bool is_ready = plan_.is_running && plan_.ready == plan_.order.size();
  const bool has_time = 2 * plan_.worked <= plan_.most_blocks;
  if (is_ready && has_time && !plan_.has_told) tell_residuals(state);
}

/// What the messages of the plan hold of the residual, where all means are now. All at once: a landmark that is tied on
/// two sides of the hub must be in one place for both.
void CondensationTree::tell_residuals(const InformationState& state) {
  for (const int at : plan_.stale) read(state, at);
  for (const int g : plan_.begun) node(g).group.read.setZero();
  for (const int at : plan_.order) tell_residual(at);
  plan_.has_told = true;
}

bool CondensationTree::move_zone(InformationState& state) {
  if (!plan_.has_told) tell_residuals(state);
  switch_leaves();
  for (const int at : plan_.order) replace(at);
  plan_.is_running = false;
  plan_.has_told = false;
  const bool done = fill_zone(state);
  for (const FrozenPiece& piece : plan_.fresh.all()) add_to_element(piece);
  plan_.fresh.clear();
  for (const int leaf : plan_.new_leaves) attach(leaf);
  plan_.new_leaves.clear();
  return done;
}

void CondensationTree::reserve_boundary(Eigen::Index rows) {
  if (rows <= part_step_.size()) return;
  part_step_.resize(2 * rows);
  part_residual_.resize(2 * rows);
}

/// What a message or an element holds of the residual of its boundary as that is now, brought to the places of the
/// plan.
Eigen::VectorXd::SegmentReturnType CondensationTree::residual_of(const Condensed& part) {
  reserve_boundary(part.b);
  auto d = part_step_.head(part.b);
  auto r = part_residual_.head(part.b);
  step_of(part, d);
  part.residual(d, r);
  if (options_.turns) {
    list_places(part);
    boundary_.fit(near(), places_);
    boundary_.bring_residual(r);
  }
  blocks_touched_ += part.blocks();
  return r;
}

void CondensationTree::switch_leaves() {
  for (int h = 0; h < zone_.size(); ++h) {
    CondensedLandmark& p = landmark(zone_.slot(h));
    p.read = zone_read_.segment<2>(2 * h);
    p.zone_index = none;
  }
  for (const int leaf : hot_leaves_) node(leaf).hot = node(leaf).next_hot;
  for (const int leaf : plan_.hot_leaves) node(leaf).hot = true;
  hot_leaves_ = plan_.hot_leaves;
  hot_leaves_.insert(hot_leaves_.end(), plan_.new_leaves.begin(), plan_.new_leaves.end());
  changed_.clear();
  tree_.move_hub();
}

/// A planned message, after those that it depends on.
void CondensationTree::tell_residual(int at) {
  Condensed& message = plan_.messages[static_cast<std::size_t>(node(at).planned)].message;
  for (Condensed::Tie& tie : message.tied) read_mean(tie.variable, tie.reference.data());
  message.reference.resize(static_cast<std::size_t>(message.b));
  double* reference = message.reference.data();
  for (const Condensed::Member& m : message.boundary) {
    read_mean(m.variable, reference);
    reference += freedom(m.variable);
  }
  condense_residual(at, message);
}

/// A node's message by the planned one.
void CondensationTree::replace(int at) {
  forget(node(at).sent);
  SentMessage& now = at == tree_.hub() ? to_zone_ : node(at).sent;
  forget(now);
  now.take(plan_.messages[static_cast<std::size_t>(node(at).planned)]);
  for (const FrontVariable v : now.message.eliminated) settle(v, at);
  for (const Condensed::Tie& tie : now.message.tied) settle(tie.variable, at);
}

void CondensationTree::forget(SentMessage& sent) {
  for (const int g : sent.groups) --node(g).group.fronts;
  sent.groups.clear();
  sent.message.clear();
}

void CondensationTree::settle(FrontVariable v, int at) {
  if (is_group(v)) {
    LandmarkGroup& group = node(~v).group;
    group.settled_at = at;
    group.mean = group.read;
  } else {
    landmark(v).settled_at = at;
    landmark(v).mean = landmark(v).read;
  }
}

void CondensationTree::condense_residual(int at, Condensed& message) {
  front_.begin_residual(message);
  if (!next_of(at).is_bare) add_part_residuals(at);
  if (tree_.planned_towards(at) == none) {
    const auto add_own = [&](int leaf) { front_.add_residual(node(leaf).own, residual_of(node(leaf).own)); };
    for (const int leaf : plan_.hot_leaves) add_own(leaf);
    if (held_leaf_ != none) add_own(held_leaf_);
  }
  front_.condense_residual(message);
}

/// What comes to a node that condenses, through bare ones or not.
void CondensationTree::add_part_residuals(int at) {
  tree_.for_each_planned_source(at, [&](int source) {
    const SentMessage& part = next_of(source);
    if (tree_.is_leaf(source)) {
      if (!node(source).next_hot) front_.add_residual(node(source).own, residual_of(node(source).own));
    } else if (part.is_bare) {
      add_part_residuals(source);
    } else if (is_stale(source)) {  // it has told of the residual where the means are
      const Condensed& m = part.message;
      front_.add_residual(m, Eigen::Map<const Eigen::VectorXd>(m.s.data(), m.b));
    } else {
      front_.add_residual(part.message, residual_of(part.message));
    }
  });
}

/// What has come to the hub, and what has been frozen since; those that are not active are eliminated.
bool CondensationTree::fill_zone(InformationState& state) {
  zone_.load(sent(tree_.hub()).message);
  for (int h = 0; h < zone_.size(); ++h) take_into_zone(zone_.slot(h), h);
  if (options_.turns) bring_zone();
  for (const int leaf : hot_leaves_) {
    for_each_landmark(leaf, [&](int slot) {
      if (landmark(slot).zone_index == none) take_into_zone(slot, zone_.add(slot, landmark(slot).read));
    });
  }
  for (const Held& held : held_) {
    if (landmark(held.slot).zone_index == none)
      take_into_zone(held.slot, zone_.add(held.slot, landmark(held.slot).read));
  }
  for (const FrozenPiece& piece : plan_.fresh.all()) bring_to_zone(piece);
  carry_window(state);
  anchor_zone();
  zone_indices_.clear();
  for (int h = 0; h < zone_.size(); ++h) {
    if (state.position(zone_.slot(h)) < 0) zone_indices_.push_back(h);
  }
  zone_followed_at_ = ++epoch_;
  return zone_indices_.empty() || zone_.eliminate(zone_indices_);
}

void CondensationTree::take_into_zone(int slot, int h) {
  landmark(slot).zone_index = h;
  zone_.set_mean(h, landmark(slot).read);
}

}  // namespace seif
