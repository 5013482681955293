#include "seif/tree/zone_switch.hpp"

#include <algorithm>

#include "seif/linearisation.hpp"
#include "seif/packed_triangle.hpp"
#include "seif/tree/leaf_element.hpp"
#include "seif/tree/room.hpp"

namespace seif {

bool ZoneSwitch::move(InformationState& state) {
  bring_incoming();
  switch_leaves();
  for (const int at : plan_.order) replace(at);
  plan_.is_running = false;
  load();
  add_rest();
  for (const FrozenPiece& piece : plan_.fresh.all()) bring_to_zone(piece);
  carry_window(state);
  anchor_zone();
  return eliminate_inactive(state);
}

bool ZoneSwitch::carry(InformationState& state) {
  list_inactive(state);
  if (!inactive_.empty() && !zone_.restore(inactive_)) return false;
  release_held();
  bring_zone([this](int h) { return zone_.mean(h); });
  carry_window(state);
  anchor_zone();
  return eliminate_inactive(state);
}

/// Loading, bringing and elimination each pass over the zone.
std::int64_t ZoneSwitch::expected_blocks() const {
  const Condensed& message = plan_.messages[plan_.order.size() - 1].message;
  return 3 * message.boundary_blocks();
}

/// What comes to the zone goes with what stays there: by the motion of the whole since the plan began. To `read`.
void ZoneSwitch::bring_incoming() {
  const Condensed& message = plan_.messages[plan_.order.size() - 1].message;
  boundary_.begin(records_.turning());
  for (const Condensed::Member& m : message.boundary) {
    const CondensedLandmark& p = records_.landmark(m.variable);
    if (p.zone_index != none) boundary_.add({.before = p.planned, .now = p.read});
  }
  const BodyMotion motion = boundary_.fit();
  for (const Condensed::Member& m : message.boundary) {
    CondensedLandmark& p = records_.landmark(m.variable);
    if (p.zone_index == none) p.read = motion.moved(p.planned);
  }
}

void ZoneSwitch::switch_leaves() {
  for (int h = 0; h < zone_.size(); ++h) records_.landmark(zone_.slot(h)).zone_index = none;
  for (const int leaf : records_.hot_leaves) records_.node(leaf).hot = records_.node(leaf).next_hot;
  for (const int leaf : plan_.hot_leaves) records_.node(leaf).hot = true;
  records_.hot_leaves = plan_.hot_leaves;
  records_.hot_leaves.insert(records_.hot_leaves.end(), plan_.new_leaves.begin(), plan_.new_leaves.end());
  for (const int n : records_.path) records_.node(n).on_path = records_.node(n).next_on_path;
  for (const int n : plan_.path) {
    records_.node(n).on_path = true;
    records_.node(n).ring = records_.node(n).next_ring;
  }
  records_.path = plan_.path;
  records_.top_ring = plan_.top_ring;
}

/// A node's message by the planned one.
void ZoneSwitch::replace(int at) {
  SentMessage& now = records_.sent(at);
  forget(now);
  now.take(plan_.messages[static_cast<std::size_t>(records_.node(at).planned)]);
  for (const FrontVariable v : now.message.eliminated) settle(v, at);
  for (const Condensed::Tie& tie : now.message.tied) settle(tie.variable, at);
}

void ZoneSwitch::forget(SentMessage& sent) {
  for (const int g : sent.groups) --records_.node(g).group.fronts;
  sent.groups.clear();
  sent.message.clear();
}

void ZoneSwitch::settle(FrontVariable v, int at) {
  if (is_group(v)) {
    LandmarkGroup& group = records_.node(~v).group;
    group.settled_at = at;
    group.mean = group.planned;
  } else {
    CondensedLandmark& p = records_.landmark(v);
    p.settled_at = at;
    p.mean = p.planned;
  }
}

/// What has come to ring 0 goes from where the plan had it to where its landmarks are now.
void ZoneSwitch::load() {
  Condensed& message = records_.sent(0).message;
  zone_.load(message);
  message.S.clear();  // the zone has it
  for (int h = 0; h < zone_.size(); ++h) records_.landmark(zone_.slot(h)).zone_index = h;
  bring_zone([this](int h) { return Eigen::Vector2d(records_.landmark(zone_.slot(h)).planned); });
}

template <class PlaceBefore>
void ZoneSwitch::bring_zone(PlaceBefore&& place_before) {
  places_.clear();
  for (int h = 0; h < zone_.size(); ++h) {
    const Eigen::Vector2d now = records_.landmark(zone_.slot(h)).read;
    places_.push_back({.before = place_before(h), .now = now});
    zone_.set_mean(h, now);
  }
  boundary_.fit(records_.turning(), places_);
  zone_.bring(boundary_, places_);
}

/// Landmarks of the zone of which nothing is frozen yet.
void ZoneSwitch::add_rest() {
  const auto add = [&](int slot) {
    CondensedLandmark& p = records_.landmark(slot);
    if (p.zone_index == none) p.zone_index = zone_.add(slot, p.read);
  };
  for (const int leaf : records_.hot_leaves) records_.for_each_landmark(leaf, add);
  std::ranges::for_each(held_.slots, add);
}

void ZoneSwitch::anchor_zone() {
  for (std::size_t i = 0; i < held_.slots.size(); ++i) {
    for (std::size_t j = 0; j < held_.slots.size(); ++j)
      held_block(i, j) = zone_.block(held_index(i), held_index(j));
  }
  for (std::size_t i = 0; i < held_.slots.size(); ++i) {
    const int h = held_index(i);
    zone_.add_information(h, h, held_.weight * Eigen::Matrix2d::Identity());
    zone_.residual(h) += held_.weight * (held_.at[i] - zone_.mean(h));
  }
}

/// Takes out what anchor_zone() has added.
void ZoneSwitch::release_held() {
  for (std::size_t i = 0; i < held_.slots.size(); ++i) {
    for (std::size_t j = 0; j < held_.slots.size(); ++j)
      zone_.block(held_index(i), held_index(j)) = held_block(i, j);
    zone_.residual(held_index(i)).setZero();
  }
  if (!held_.slots.empty()) balance_held();
}

/// What is frozen can be moved and turned freely as a whole, so its pulls have no sum and no torque. This gives the
/// pulls at the held landmarks from all others.
void ZoneSwitch::balance_held() {
  const auto count = static_cast<double>(held_.slots.size());
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < held_.slots.size(); ++i) middle += zone_.mean(held_index(i)) / count;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double torque = 0.0;
  for (int h = 0; h < zone_.size(); ++h) {
    const Eigen::Vector2d pull = zone_.residual(h);
    const Eigen::Vector2d lever = zone_.mean(h) - middle;
    sum += pull;
    torque += lever.x() * pull.y() - lever.y() * pull.x();
  }
  double squared_levers = 0.0;
  for (std::size_t i = 0; i < held_.slots.size(); ++i)
    squared_levers += (zone_.mean(held_index(i)) - middle).squaredNorm();
  for (std::size_t i = 0; i < held_.slots.size(); ++i) {
    const Eigen::Vector2d lever = zone_.mean(held_index(i)) - middle;
    zone_.residual(held_index(i)) =
        -sum / count - torque / squared_levers * Eigen::Vector2d(-lever.y(), lever.x());
  }
}

void ZoneSwitch::add_to_held(int slot, int other, const Eigen::Matrix2d& Omega) {
  const auto a = std::ranges::find(held_.slots, slot);
  const auto b = std::ranges::find(held_.slots, other);
  if (a == held_.slots.end() || b == held_.slots.end()) return;
  const auto i = static_cast<std::size_t>(a - held_.slots.begin());
  const auto j = static_cast<std::size_t>(b - held_.slots.begin());
  held_block(i, j) += Omega;
  if (i != j) held_block(j, i) += Omega.transpose();
}

void ZoneSwitch::add_to_zone(const FrozenPiece& piece) {
  const auto index_of = [&](int slot) { return records_.landmark(slot).zone_index; };
  const auto mean_of = [&](int slot) { return zone_.mean(index_of(slot)); };
  for (std::size_t i = 0; i < piece.members.size(); ++i) {
    const int h = index_of(piece.members[i].slot);
    zone_.residual(h) += residual_of(piece, i, mean_of);
    for (std::size_t j = 0; j <= i; ++j) {
      zone_.add_information(h, index_of(piece.members[j].slot), piece.block(i, j));
      add_to_held(piece.members[i].slot, piece.members[j].slot, piece.block(i, j));
    }
  }
}

/// A piece that was frozen in the zone before: where its members are now.
void ZoneSwitch::bring_to_zone(const FrozenPiece& piece) {
  if (piece.members.empty()) return;
  places_.clear();
  for (const FrozenPiece::Member& m : piece.members)
    places_.push_back({.before = m.reference, .now = zone_.mean(records_.landmark(m.slot).zone_index)});
  boundary_.fit(records_.turning(), places_);
  piece_.copy(piece);
  const Eigen::Index n = piece.rows();
  make_room(square_, n * n);
  Eigen::Map<Eigen::MatrixXd> Omega(square_.data(), n, n);
  unpack_triangle(piece_.Omega.data(), Omega);
  Eigen::Map<Eigen::VectorXd> r(piece_.r.data(), n);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    r.noalias() -= Omega.middleCols<2>(static_cast<Eigen::Index>(2 * i)) * boundary_.step(i);
    piece_.members[i].reference = places_[i].now;
  }
  boundary_.bring(Omega);
  boundary_.bring_residual(r);
  pack_triangle(Omega, piece_.Omega.data());
  blocks_touched_ += Condensed::blocks_of(n);
  add_to_zone(piece_);
}

/// From now on the Jacobians of the window are taken where its landmarks are now.
void ZoneSwitch::carry_window(InformationState& state) {
  if (!records_.options.turns || !state.first_estimates().in_use()) return;
  carry_first_estimates(state, records_.turning(), boundary_);
  for (int h = 0; h < zone_.size(); ++h) state.first_estimates().set_point(zone_.slot(h), zone_.mean(h));
}

void ZoneSwitch::list_inactive(const InformationState& state) {
  inactive_.clear();
  for (int h = 0; h < zone_.size(); ++h) {
    if (state.position(zone_.slot(h)) < 0) inactive_.push_back(h);
  }
}

bool ZoneSwitch::eliminate_inactive(const InformationState& state) {
  list_inactive(state);
  return inactive_.empty() || zone_.eliminate(inactive_);
}

}  // namespace seif
