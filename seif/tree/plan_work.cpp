#include "seif/tree/plan_work.hpp"

#include <algorithm>

namespace seif {

/// Visits what will send to it.
template <class Visit>
void PlanWork::for_each_next_source(int at, Visit&& visit) const {
  if (!CondensationRecords::is_ring(at)) {
    if (records_.node(at).next_on_path) return;
    for (const int child : records_.tree.children(at)) {
      if (child != none) visit(child);
    }
    return;
  }
  if (at < plan_.top_ring) visit(at + 1);
  for (const int n : plan_.path) {
    if (records_.node(n).next_ring != at) continue;
    for (const int child : records_.tree.children(n)) {
      if (child != none && !records_.node(child).next_on_path) visit(child);
    }
  }
}

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
  return is_stale(at) ? plan_.messages[static_cast<std::size_t>(records_.node(at).planned)]
                      : records_.node(at).sent;
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
  next.is_bare = is_bare(at);
  ++blocks_touched_;
  if (next.is_bare) return begin_bare(at, next);
  front_.begin();
  gather(at);
  if (at == 0) {
    for (const int leaf : plan_.carried) front_.add(records_.node(leaf).own);
  }
  grouping_.tie_front(state, next);
  front_.divide([&](FrontVariable v, int balance) { return is_complete(at, v, balance); }, next.message);
  is_in_front_ = true;
}

/// Where condensing would not pay: at small nodes, at those hardly larger than a child, and in rings to which only the
/// next outer one sends.
bool PlanWork::is_bare(int at) const {
  if (at == 0) return false;
  if (CondensationRecords::is_ring(at)) {
    return std::ranges::none_of(plan_.path, [&](int n) { return records_.node(n).next_ring == at; });
  }
  if (records_.node(at).next_on_path) return true;
  const auto size = [&](int n) { return CondensationRecords::ring_of(records_.tree.leaves(n)); };
  const auto is_as_large = [&](int child) { return child != none && size(child) == size(at); };
  return size(at) == 0 || std::ranges::any_of(records_.tree.children(at), is_as_large);
}

void PlanWork::begin_bare(int at, SentMessage& next) {
  next.message.clear();
  next.groups.clear();
  if (!CondensationRecords::is_ring(at) && records_.tree.is_leaf(at) && !records_.node(at).next_hot) {
    for (Condensed::Member& m : records_.node(at).own.boundary) {
      const CondensedLandmark& p = records_.landmark(m.variable);
      m.balance = p.leaf == at ? 1 - p.leaves : 1;
    }
  }
  note_reach(at, next);
  ++plan_.ready;
}

/// Brings to the front what is sent to it, or what comes through bare ones. What is new is where the plan has it.
void PlanWork::gather(int at) {
  for_each_next_source(at, [&](int source) {
    const SentMessage& next = next_of(source);
    if (!CondensationRecords::is_ring(source) && records_.tree.is_leaf(source)) {
      front_.add(records_.node(source).own, false);
    } else if (next.is_bare) {
      gather(source);
    } else {
      front_.add(next.message, is_stale(source));
    }
  });
}

/// Whether all blocks of a variable are in the front. In the zone those of all cold ones are.
bool PlanWork::is_complete(int at, FrontVariable v, int balance) const {
  const bool is_cold = is_group(v) || !records_.node(records_.landmark(v).leaf).next_hot;
  if (at == 0 || !is_cold) return is_cold;
  if (balance != 0) return false;
  if (!is_group(v)) return true;
  if (!CondensationRecords::is_ring(at)) return records_.tree.is_within(~v, at);
  int n = ~v;
  while (!records_.node(n).next_on_path) n = records_.tree.parent(n);
  return records_.node(n).next_ring >= at;
}

/// From now on it holds for where the plan has its variables.
void PlanWork::finish_message() {
  front_.finish();
  SentMessage& next = current();
  Condensed& message = next.message;
  for (Condensed::Tie& tie : message.tied)
    records_.read_mean(tie.variable, Means::planned, tie.reference.data());
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
  for_each_next_source(at, [&](int source) { next.reach.extend(next_of(source).reach); });
}

}  // namespace seif
