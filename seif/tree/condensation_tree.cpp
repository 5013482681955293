// The live path: joining, activation, the solution, and reading.
#include "seif/tree/condensation_tree.hpp"

#include <algorithm>

namespace seif {

// Landmarks join.

void CondensationTree::join(const InformationState& state, int slot) {
  const Eigen::Vector2d home = state.mean(slot) + choice_.home_offset();
  enter(state, slot, leaves_.in_zone(state.mean(slot), home), home);
  records_.landmark(slot).zone_index = zone_.add(slot, state.mean(slot));
  ++epoch_;
}

void CondensationTree::join_anywhere(const InformationState& state, int slot, const Eigen::Vector2d& home) {
  enter(state, slot, leaves_.anywhere(home), home);
}

void CondensationTree::enter(const InformationState& state, int slot, int leaf, const Eigen::Vector2d& home) {
  records_.landmarks.push_back({.leaf = leaf, .next = records_.node(leaf).first_landmark, .home = home});
  records_.landmark(slot).planned = state.mean(slot);
  records_.node(leaf).first_landmark = slot;
  records_.tree.widen(leaf, home);
  ++records_.node(leaf).landmarks;
}

void CondensationTree::hold(const InformationState& state, std::span<const int> slots, double sd) {
  const int leaf = records_.held_leaf = records_.tree.new_leaf();
  records_.nodes.push_back({});
  records_.node(leaf).hot = records_.node(leaf).next_hot = true;
  held_.weight = 1.0 / (sd * sd);
  for (const int slot : slots) {
    records_.landmarks.push_back(
        {.leaf = leaf, .next = records_.node(leaf).first_landmark, .home = state.mean(slot)});
    records_.node(leaf).first_landmark = slot;
    ++records_.node(leaf).landmarks;
    records_.landmark(slot).zone_index = zone_.add(slot, state.mean(slot));
    held_.slots.push_back(slot);
    held_.at.push_back(state.mean(slot));
  }
  const auto rows = 2 * static_cast<Eigen::Index>(held_.slots.size());
  held_.Omega.setZero(rows, rows);
  switch_.anchor_zone();
  ++epoch_;
}

// The window.

bool CondensationTree::activate(InformationState& state, std::vector<int>& slots, double range) {
  update_begun_at_ = blocks_touched() + state.blocks_touched();
  choice_.begin_scan(state, slots, range);
  if (!plan_.is_running && choice_.choose(state, slots, zone_.size(), plan_.hot_leaves))
    begin_plan(state, false);
  if (records_.options.most_blocks == 0 && !finish_plan(state)) return false;
  waited_ += static_cast<std::int64_t>(std::erase_if(slots, [&](int slot) { return !is_ready(slot); }));
  zone_indices_.clear();
  for (const int slot : slots) {
    const int h = records_.landmark(slot).zone_index;
    if (state.position(slot) < 0 && std::ranges::find(zone_indices_, h) == zone_indices_.end())
      zone_indices_.push_back(h);
  }
  if (zone_indices_.empty()) return true;
  follow_in_zone(state);
  ++epoch_;
  if (!zone_.restore(zone_indices_)) return false;
  for (const int h : zone_indices_) {
    state.set_mean(zone_.slot(h), zone_.mean(h));
    state.activate(zone_.slot(h));
  }
  return true;
}

/// Whether a landmark may be active: in this zone and, if one is planned, in the next.
bool CondensationTree::is_ready(int slot) const {
  const CondensedLandmark& p = records_.landmark(slot);
  return p.zone_index != none && records_.node(p.leaf).next_hot;
}

bool CondensationTree::freeze(const InformationState& state, const FrozenPiece& piece) {
  follow_in_zone(state);
  ++epoch_;
  zone_indices_.clear();
  for (const int slot : piece.slots) zone_indices_.push_back(records_.landmark(slot).zone_index);
  switch_.add_to_zone(piece);
  if (plan_.is_running) {
    plan_.fresh.add(piece);
  } else {
    add_to_elements(piece);
  }
  return zone_.eliminate(zone_indices_);
}

/// A piece of landmarks in the zone: all that is known of the places of others is old.
void CondensationTree::add_to_elements(const FrozenPiece& piece) {
  elements_.add(piece, [&](int slot) {
    const int h = records_.landmark(slot).zone_index;
    return h == none ? std::nullopt : std::optional(zone_.mean(h));
  });
}

bool CondensationTree::solve_window(InformationState& state) {
  ++epoch_;
  return window_.solve(state);
}

bool CondensationTree::carry(InformationState& state) {
  read_zone(state);
  const bool done = switch_.carry(state);
  zone_followed_at_ = ++epoch_;
  return done;
}

// Plans.

/// `planned` of all hot landmarks is what their means are now.
void CondensationTree::begin_plan(const InformationState& state, bool of_all) {
  read_zone(state);
  for (int h = 0; h < zone_.size(); ++h) {
    const CondensedLandmark& p = records_.landmark(zone_.slot(h));
    p.planned = p.read;
  }
  if (of_all) {
    marking_.begin_all();
  } else {
    marking_.begin();
  }
  switch_waits_ = false;
}

/// All at once, and the zone moves; also if none is planned.
bool CondensationTree::finish_plan(InformationState& state) {
  if (!plan_.is_running) return true;
  while (!plan_.is_ready()) {
    if (!work_.step(state)) return false;
  }
  return move_zone(state);
}

bool CondensationTree::move_zone(InformationState& state) {
  read_zone(state);
  const bool done = switch_.move(state);
  zone_followed_at_ = ++epoch_;
  for (const FrozenPiece& piece : plan_.fresh.all()) add_to_elements(piece);
  plan_.fresh.clear();
  marking_.forget_changes();
  for (const int leaf : plan_.new_leaves) leaves_.attach(leaf);
  plan_.new_leaves.clear();
  return done;
}

// What others know.

void CondensationTree::add_anywhere(const InformationState& state, const FrozenPiece& piece) {
  elements_.add(piece, [&](int slot) { return std::optional(mean(state, slot)); });
  for (const FrozenPiece::Member& m : piece.members) news_.add(m.slot);
}

void CondensationTree::begin_news_plan(const InformationState& state) {
  news_.linearise([&](int slot) { return mean(state, slot); });
  news_.for_each([&](int slot) { marking_.note_news(records_.landmark(slot).leaf); });
  plan_.hot_leaves = records_.hot_leaves;
  begin_plan(state, false);
  plan_.has_news = true;
  leaves_.begin_news();
}

/// What a closure far away has moved is linearised again where it is now.
void CondensationTree::repeat_news(const InformationState& state) {
  constexpr double most_sigmas = 3.0;  // of a sighting
  const double most = most_sigmas * state.first_estimates().sighting_sd();
  blocks_touched_ += static_cast<std::int64_t>(news_.size());
  if (news_.must_repeat(records_.turning(), most, [&](int slot) { return mean(state, slot); }))
    begin_news_plan(state);
}

bool CondensationTree::solve_all(InformationState& state) {
  if (!finish_plan(state)) return false;
  grouping_.allow(false);
  begin_plan(state, true);
  const bool done = finish_plan(state) && solve_window(state);
  grouping_.allow(true);
  return done;
}

bool CondensationTree::bring(InformationState& state, std::span<const int> slots) {
  if (std::ranges::all_of(slots, [&](int slot) { return is_ready(slot); })) return true;
  if (!finish_plan(state)) return false;
  for (const int slot : slots) choice_.want(slot);
  if (choice_.choose(state, slots, zone_.size(), plan_.hot_leaves)) begin_plan(state, false);
  return finish_plan(state);
}

/// Of those that this update may touch; more when the robot would arrive before the next zone is ready, and when a
/// closure has bent the zone. [-]
std::int64_t CondensationTree::blocks_left(const InformationState& state) const {
  constexpr double ready_after = 0.6;  // of the updates until the robot arrives
  constexpr int news_share = 4;        // [-] the zone cannot move until the plan is ready
  const std::int64_t most = records_.options.most_blocks;
  const std::int64_t touched = blocks_touched() + state.blocks_touched() - update_begun_at_;
  const bool is_late = plan_.updates > ready_after * choice_.updates_to_arrive();
  if (plan_.has_news) return std::max(most, news_share * most - touched);
  return std::max(most / 4, (is_late || plan_.is_urgent ? most + most / 3 : most) - touched);
}

bool CondensationTree::end_update(InformationState& state) {
  if (!plan_.is_running && !news_.is_empty()) repeat_news(state);
  if (records_.options.most_blocks == 0) return true;
  if (!plan_.is_running && records_.options.turns && choice_.is_bent(state)) {
    plan_.hot_leaves = records_.hot_leaves;
    begin_plan(state, false);
    plan_.is_urgent = true;
  }
  if (!plan_.is_running) return true;
  ++plan_.updates;
  const std::int64_t until = blocks_touched() + blocks_left(state);
  while (!plan_.is_ready() && blocks_touched() < until) {
    if (!work_.step(state)) return false;
  }
  if (!plan_.is_ready()) return true;
  const bool has_room = blocks_touched() + switch_.expected_blocks() <= until;
  if (has_room || switch_waits_) return move_zone(state);
  switch_waits_ = true;
  return true;
}

// Means. Reading leaves no trace: what it finds goes to `read`, and holds until epoch_ counts on. Following
// writes it down where the next step starts from.

void CondensationTree::read_zone(const InformationState& state) const {
  if (zone_read_at_ == epoch_) return;
  zone_read_at_ = epoch_;
  zone_.follow([&](int slot) { return state.mean(slot); }, zone_read_);
  for (int h = 0; h < zone_.size(); ++h) records_.landmark(zone_.slot(h)).read = zone_read_.segment<2>(2 * h);
}

/// What was settled at this node or ring, and at all from there to the zone.
void CondensationTree::read(const InformationState& state, int at) const {
  const CondensationNode& n = records_.node(at);
  if (n.read_at == epoch_) return;
  n.read_at = epoch_;
  if (const int next = records_.receiver(at); next != none) {
    read(state, next);
  } else {
    read_zone(state);
  }
  live_reader_.read(at, Means::read);
}

Eigen::Vector2d CondensationTree::mean(const InformationState& state, int slot) const {
  if (state.position(slot) >= 0) return state.mean(slot);
  const CondensedLandmark& p = records_.landmark(slot);
  if (p.zone_index != none) {
    read_zone(state);
  } else if (p.settled_at == none) {
    return p.planned;  // news of which no plan knows yet
  } else {
    read(state, p.settled_at);
  }
  return p.read;
}

void CondensationTree::follow_in_zone(const InformationState& state) {
  if (zone_followed_at_ == epoch_) return;
  zone_followed_at_ = epoch_;
  read_zone(state);
  zone_.set_means(zone_read_);
  blocks_touched_ += std::int64_t{state.active_count()} * zone_.size();
}

std::int64_t CondensationTree::blocks_touched() const {
  return blocks_touched_ + zone_.blocks_touched() + front_.blocks_touched() + reader_.blocks_touched() +
         work_.blocks_touched() + switch_.blocks_touched() + elements_.blocks_touched();
}

std::size_t CondensationTree::memory_bytes() const {
  std::size_t bytes = records_.memory_bytes() + front_.memory_bytes() + zone_.memory_bytes();
  for (const SentMessage& planned : plan_.messages) bytes += sizeof(planned) + planned.message.memory_bytes();
  return bytes;
}

}  // namespace seif
