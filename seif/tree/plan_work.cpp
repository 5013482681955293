#include "seif/tree/plan_work.hpp"

namespace seif {

bool PlanWork::step(const InformationState& state) {
  if (plan_.read < plan_.readings.size()) {
    reader_.read(plan_.readings[plan_.read++], Means::planned);
  } else if (plan_.carried_so_far < plan_.carried.size()) {
    carry(plan_.carried[plan_.carried_so_far++]);
  } else if (plan_.is_ready()) {
    return true;
  } else if (!is_in_front_) {
    begin_message(state, plan_.order[plan_.ready]);
  } else if (const Front::Part* part = front_.next_part()) {
    if (!part->is_in_place) records_.list_places(*part->condensed, Means::planned, places_);
    front_.assemble_next(records_.turning(), places_);
  } else if (front_.has_columns_left()) {
    return front_.eliminate_next();
  } else {
    finish_message();
  }
  return true;
}

/// What a node will have sent once the zone has moved.
const SentMessage& PlanWork::next_of(int at) const {
  return is_stale(at) ? plan_.messages[static_cast<std::size_t>(records_.node(at).planned)] : records_.node(at).sent;
}

/// The element of a hot leaf is taken where its landmarks are, with what it pulls there.
void PlanWork::carry(int leaf) {
  Condensed& element = records_.node(leaf).own;
  if (element.b == 0) return;
  records_.list_places(element, Means::planned, places_);
  element_mover_.carry(records_.turning(), places_, element);
  blocks_touched_ += element.boundary_blocks();
}

void PlanWork::begin_message(const InformationState& state, int at) {
  SentMessage& next = current();
  const bool is_hub = records_.tree.planned_towards(at) == none;
  next.is_bare = !is_hub && records_.tree.leaves(at) <= CondensationRecords::most_bare;
  ++blocks_touched_;
  if (next.is_bare) return begin_bare(at, next);
  front_.begin();
  gather(at);
  if (is_hub) {
    for (const int leaf : plan_.carried) front_.add(records_.node(leaf).own);
  }
  grouping_.tie_front(state, next);
  front_.divide([&](FrontVariable v, int balance) { return is_complete(at, v, balance); }, next.message);
  is_in_front_ = true;
}

void PlanWork::begin_bare(int at, SentMessage& next) {
  next.message.clear();
  next.groups.clear();
  if (records_.tree.is_leaf(at) && !records_.node(at).next_hot) {
    for (Condensed::Member& m : records_.node(at).own.boundary) {
      const CondensedLandmark& p = records_.landmark(m.variable);
      m.balance = p.leaf == at ? 1 - p.leaves : 1;
    }
  }
  note_reach(at, next);
  ++plan_.ready;
}

/// Brings to the front of a node what its sources send, or what comes through them. What is new is where the plan has
/// it.
void PlanWork::gather(int at) {
  records_.tree.for_each_planned_source(at, [&](int source) {
    const SentMessage& next = next_of(source);
    if (records_.tree.is_leaf(source)) {
      if (!records_.node(source).next_hot) front_.add(records_.node(source).own, false);
    } else if (next.is_bare) {
      gather(source);
    } else {
      front_.add(next.message, is_stale(source));
    }
  });
}

/// Whether all blocks of a variable are in the front of a node. At the hub those of all cold ones are.
bool PlanWork::is_complete(int at, FrontVariable v, int balance) const {
  const LeafTree& tree = records_.tree;
  const bool is_cold = is_group(v) || !records_.node(records_.landmark(v).leaf).next_hot;
  const int next = tree.planned_towards(at);
  if (next == none || !is_cold) return is_cold;
  if (balance != 0) return false;
  if (!is_group(v)) return true;
  const bool comes_from_below = next == tree.parent(at);
  return comes_from_below ? tree.is_within(~v, at) : !tree.is_within(~v, next) && !tree.is_within(next, ~v);
}

/// From now on it holds for where the plan has its variables.
void PlanWork::finish_message() {
  front_.finish();
  SentMessage& next = current();
  Condensed& message = next.message;
  for (Condensed::Tie& tie : message.tied) records_.read_mean(tie.variable, Means::planned, tie.reference.data());
  message.reference.resize(static_cast<std::size_t>(message.b));
  double* reference = message.reference.data();
  for (const Condensed::Member& m : message.boundary) {
    records_.read_mean(m.variable, Means::planned, reference);
    reference += freedom(m.variable);
  }
  for (const int g : next.groups) ++records_.node(g).group.fronts;
  note_reach(plan_.order[plan_.ready], next);
  is_in_front_ = false;
  ++plan_.ready;
}

void PlanWork::note_reach(int at, SentMessage& next) const {
  next.reach = grouping_.reach(next.groups);
  records_.tree.for_each_planned_source(at, [&](int source) { next.reach.extend(next_of(source).reach); });
}

}  // namespace seif
