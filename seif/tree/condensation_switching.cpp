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

/// What the messages of the plan hold of the residual, where all means are now. Once only: it takes what is
/// loose. And all at once: a landmark that is tied on two sides of the hub has to be told of in one place.
void CondensationTree::tell_residuals(const InformationState& state) {
  for (const int at : plan_.stale) read(state, at);
  note_zone_residual(state);
  for (const int at : plan_.stale) {
    if (tree_.is_leaf(at) && !node(at).hot) loosen(at);
  }
  for (const int g : plan_.begun) node(g).group.read = node(g).group.mean;
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
  for (const int leaf : plan_.new_leaves) attach(leaf);
  plan_.new_leaves.clear();
  return done;
}

void CondensationTree::reserve_boundary(Eigen::Index rows) {
  if (rows <= part_step_.size()) return;
  part_step_.resize(2 * rows);
  part_residual_.resize(2 * rows);
}

/// What the message of a node holds of the residual of its boundary, as that is now.
Eigen::VectorXd::SegmentReturnType CondensationTree::residual_of(int at) {
  const Condensed& message = sent(at).message;
  reserve_boundary(message.b);
  auto d = part_step_.head(message.b);
  auto r = part_residual_.head(message.b);
  step_of(message, d);
  if (message.b == 0) return r;  // of a hot leaf, or a new one
  message.residual(d, r);
  blocks_touched_ += message.blocks();
  return r;
}

/// What the messages to the hub hold of the residual of hot landmarks.
void CondensationTree::take_from_loose() {
  for_each_part(tree_.hub(), [&](int source) {
    const Condensed& m = sent(source).message;
    const auto r = residual_of(source);
    Eigen::Index row = 0;
    for (const Condensed::Member& member : m.boundary) {
      const FrontVariable v = member.variable;
      if (!is_group(v) && landmark(v).zone_index != none) landmark(v).untold -= r.segment<2>(row);
      row += freedom(v);
    }
  });
}

/// What no message holds of the residual: of hot landmarks, and where hot leaves have blocks with cold ones.
void CondensationTree::note_zone_residual(const InformationState& state) {
  for (int h = 0; h < zone_.size(); ++h) {
    CondensedLandmark& p = landmark(zone_.slot(h));
    const int position = state.position(zone_.slot(h));
    p.untold.setZero();
    if (position >= 0) p.untold = state.r().segment<2>(InformationState::row_of(position));
  }
  take_from_loose();
  const Condensed& to_zone = sent(tree_.hub()).message;
  reserve_boundary(to_zone.b);
  auto d = part_step_.head(to_zone.b);
  step_of(to_zone, d);
  Eigen::Index row = 0;
  for (const Condensed::Member& member : to_zone.boundary) {
    const int slot = member.variable;
    state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
      if (landmark(other).zone_index != none || landmark(other).leaf < landmark(slot).leaf) return;
      landmark(other).untold -= Omega_so.transpose() * d.segment<2>(row);
    });
    row += 2;
  }
}

/// A cold leaf whose message goes: what its message held of the residual.
void CondensationTree::loosen(int leaf) {
  const Condensed& m = sent(leaf).message;
  const auto r = residual_of(leaf);
  Eigen::Index row = 0;
  for (const Condensed::Member& member : m.boundary) {
    landmark(member.variable).untold += r.segment<2>(row);
    row += 2;
  }
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
  const bool is_hub = tree_.planned_towards(at) == none;
  if (is_hub || tree_.is_leaf(at)) {
    const auto add_loose = [&](FrontVariable v) {
      if (is_group(v)) return;
      front_.add_residual(v, landmark(v).untold);
      if (!is_hub) landmark(v).untold.setZero();
    };
    for (const FrontVariable v : message.eliminated) add_loose(v);
    for (const Condensed::Member& m : message.boundary) add_loose(m.variable);
    for (const Condensed::Tie& tie : message.tied) add_loose(tie.variable);
  }
  front_.condense_residual(message);
}

/// What comes to a node that condenses, through bare ones or not.
void CondensationTree::add_part_residuals(int at) {
  tree_.for_each_planned_source(at, [&](int source) {
    const SentMessage& part = next_of(source);
    if (part.is_bare && !tree_.is_leaf(source)) {
      add_part_residuals(source);
    } else if (is_stale(source)) {  // it has told of the residual where the means are
      const Condensed& m = part.message;
      front_.add_residual(m, Eigen::Map<const Eigen::VectorXd>(m.s.data(), m.b));
    } else {
      front_.add_residual(part.message, residual_of(source));
    }
  });
}

/// What has come to the hub, and what the hot leaves have among themselves; those that are not active are
/// eliminated.
bool CondensationTree::fill_zone(InformationState& state) {
  const Condensed& to_zone = sent(tree_.hub()).message;
  zone_.load(to_zone);
  for (int h = 0; h < zone_.size(); ++h) take_into_zone(zone_.slot(h), h);
  for (const int leaf : hot_leaves_) {
    for_each_landmark(leaf, [&](int slot) {
      if (landmark(slot).zone_index == none) take_into_zone(slot, zone_.add(slot, landmark(slot).read));
    });
  }
  zone_indices_.clear();
  for (int h = 0; h < zone_.size(); ++h) {
    const int slot = zone_.slot(h);
    if (state.position(slot) < 0) {
      zone_indices_.push_back(h);
      zone_.add_information(h, h, state.information(slot));
    }
    state.for_each_neighbour(slot, [&](int other, const auto& Omega_so) {
      if (other > slot && landmark(other).zone_index != none)
        zone_.add_information(h, landmark(other).zone_index, Omega_so);
    });
  }
  zone_followed_at_ = ++epoch_;
  if (!zone_indices_.empty() && !zone_.eliminate(zone_indices_)) return false;
  pull_zone(state, Eigen::Map<const Eigen::VectorXd>(to_zone.s.data(), to_zone.b));
  return true;
}

void CondensationTree::take_into_zone(int slot, int h) {
  landmark(slot).zone_index = h;
  zone_.set_mean(h, landmark(slot).read);
}

/// What is left of the residual s of the zone, now that nearer groups have been untied: those eliminated
/// move, and the window gets it into its own.
void CondensationTree::pull_zone(InformationState& state, const Eigen::Ref<const Eigen::VectorXd>& to_zone) {
  reserve_boundary(2 * zone_.size());
  auto s = part_residual_.head(2 * zone_.size());
  for (int h = 0; h < zone_.size(); ++h) s.segment<2>(2 * h) = landmark(zone_.slot(h)).untold;
  s.head(to_zone.size()) = to_zone;
  for (int h = 0; h < zone_.size(); ++h) {
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
    for (const int p : zone_indices_) pull -= zone_.block(h, p) * s.segment<2>(2 * p);
    const int position = state.position(zone_.slot(h));
    if (position < 0) {
      zone_.set_mean(h, zone_.mean(h) + pull);
    } else {
      state.r().segment<2>(InformationState::row_of(position)) = s.segment<2>(2 * h) + pull;
    }
  }
}

}  // namespace seif
