// Where the parts of the map are now, and what they say there: how they have turned and bent since they were condensed.
// Without CondensationOptions::turns, everything stays as it was condensed.
#include <Eigen/Geometry>
#include <cstddef>
#include <span>

#include "seif/linearisation.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {

/// Where a variable with this mean is: a landmark, or the middle of a group. [m]
Eigen::Vector2d CondensationTree::place(FrontVariable v, const double* mean) const {
  const Eigen::Map<const Eigen::Vector2d> p(mean);
  return is_group(v) ? Eigen::Vector2d(node(~v).group.start + p) : Eigen::Vector2d(p);
}

/// By the means that were read last. [m]
Eigen::Vector2d CondensationTree::present_place(FrontVariable v) const {
  Eigen::Vector3d mean;
  read_mean(v, mean.data());
  return place(v, mean.data());
}

/// How the boundary of a message has moved as a whole since it was sent; in its own frame, it has gone on by d.
BodyMotion CondensationTree::step_of(const Condensed& message, Eigen::Ref<Eigen::VectorXd> d) const {
  const double* const reference = message.reference.data();
  Eigen::Index row = 0;
  boundary_.begin(near());
  for (const Condensed::Member& m : message.boundary) {
    read_mean(m.variable, &d(row));
    if (options_.turns) {
      const double turn = d(row + freedom(m.variable) - 1);
      boundary_.add(moved_place(m.variable, reference + row, place(m.variable, &d(row)), turn));
    }
    row += freedom(m.variable);
  }
  if (!options_.turns) {
    d -= Eigen::Map<const Eigen::VectorXd>(reference, message.b);
    return {};
  }
  const BodyMotion motion = boundary_.fit();
  row = 0;
  std::size_t i = 0;
  for (const Condensed::Member& m : message.boundary) {
    d.segment<2>(row) = boundary_.step(i++);
    if (is_group(m.variable)) d(row + 2) -= reference[row + 2] + motion.angle;
    row += freedom(m.variable);
  }
  return motion;
}

/// `turn`: of a group, in all.
MovedPlace CondensationTree::moved_place(FrontVariable v, const double* reference, const Eigen::Vector2d& now,
                                         double turn) const {
  if (!is_group(v)) return {.before = place(v, reference), .now = now};
  return {.before = place(v, reference), .now = now, .turn = turn - reference[2], .is_group = true};
}

/// The step of a tied landmark by a turn of its group. [m]
Eigen::Vector2d CondensationTree::lever_step(const Eigen::Vector2d& lever, double turn) const {
  if (!options_.turns) return turn * Eigen::Vector2d(-lever.y(), lever.x());
  return Eigen::Rotation2Dd(turn) * lever - lever;
}

/// The motion of a group, with that of the body that it is in.
void CondensationTree::turn_group(const BodyMotion& motion, const LandmarkGroup& group) const {
  if (motion.is_identity()) return;
  group.read.head<2>() = motion.moved(group.start + group.read.head<2>()) - group.start;
  group.read(2) += motion.angle;
}

/// Of an element, by its landmarks in the zone.
BodyMotion CondensationTree::motion_in_zone(const Condensed& element) const {
  if (!options_.turns) return {};
  boundary_.begin(near());
  const double* reference = element.reference.data();
  for (const Condensed::Member& m : element.boundary) {
    if (const int h = landmark(m.variable).zone_index; h != none)
      boundary_.add(moved_place(m.variable, reference, zone_.mean(h), 0.0));
    reference += 2;
  }
  return boundary_.fit();
}

/// A piece where its members are now.
void CondensationTree::bring_piece(std::span<const MovedPlace> places, FrozenPiece& piece) const {
  boundary_.fit(near(), places);
  const auto n = static_cast<Eigen::Index>(2 * piece.members.size());
  if (V_.rows() < n) V_.resize(2 * n, 2);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    FrozenPiece::Member& m = piece.members[i];
    piece.y -= m.V.transpose() * boundary_.step(i);
    m.reference = places[i].now;
    V_.middleRows<2>(row) = m.V;
    row += 2;
  }
  for (Eigen::Index k = 0; k < 2; ++k) boundary_.bring_residual(V_.col(k).head(n));
  row = 0;
  for (FrozenPiece::Member& m : piece.members) {
    m.V = V_.middleRows<2>(row);
    row += 2;
  }
}

/// A piece that was frozen in the zone before.
void CondensationTree::bring_to_zone(const FrozenPiece& piece) {
  if (!options_.turns) return add_to_zone(piece);
  places_.clear();
  for (const FrozenPiece::Member& m : piece.members)
    places_.push_back({.before = m.reference, .now = zone_.mean(landmark(m.slot).zone_index)});
  piece_ = piece;
  bring_piece(places_, piece_);
  add_to_zone(piece_);
}

// What a plan takes as given.

/// Where the variables of a part were when it was sent, and where the plan has them: to places_.
void CondensationTree::list_places(const Condensed& part) {
  places_.clear();
  const double* reference = part.reference.data();
  for (const Condensed::Member& m : part.boundary) {
    const double turn = is_group(m.variable) ? node(~m.variable).group.place_turn : 0.0;
    places_.push_back(moved_place(m.variable, reference, plan_place(m.variable), turn));
    reference += freedom(m.variable);
  }
}

/// For all nodes that send anew: where everything is that comes to them.
void CondensationTree::note_places(const InformationState& state, int hub) {
  front_.set_near(near());
  for (const int at : plan_.stale) read(state, at);
  for (const int at : plan_.stale) {
    note_places_of_groups(state, at);
    tree_.for_each_neighbour(at, [&](int other) { note_places_of_groups(state, other); });
  }
  for (const int at : plan_.order) {
    if (tree_.leaves(at) > most_bare || at == hub) note_places_of_sources(state, at);
  }
  for (const int leaf : plan_.hot_leaves) carry_element(state, node(leaf).own);
  if (held_leaf_ != none) carry_element(state, node(held_leaf_).own);
}

/// What does not turn stays where its Jacobians were taken.
void CondensationTree::note_place(const InformationState& state, FrontVariable v) {
  if (!options_.turns) {
    if (!is_group(v)) landmark(v).place = linearisation_point(state, v);
  } else if (is_group(v)) {
    LandmarkGroup& group = node(~v).group;
    group.place = present_place(v);
    group.place_turn = group.read(2);
  } else {
    landmark(v).place = present_place(v);
  }
}

void CondensationTree::note_places_of_groups(const InformationState& state, int at) {
  if (is_stale(at)) {
    for (const int g : sent(at).groups) note_place(state, group_variable(g));
  }
  for (const Condensed::Member& m : sent(at).message.boundary) {
    if (is_group(m.variable)) note_place(state, m.variable);
  }
}

/// Of all parts that come to a node that condenses, and are not sent anew.
void CondensationTree::note_places_of_sources(const InformationState& state, int at) {
  tree_.for_each_planned_source(at, [&](int source) {
    if (tree_.is_leaf(source)) {
      if (!node(source).next_hot) note_places_of(state, node(source).own);
    } else if (tree_.leaves(source) <= most_bare) {
      note_places_of_sources(state, source);
    } else if (!is_stale(source)) {
      note_places_of(state, node(source).sent.message);
    }
  });
}

void CondensationTree::note_places_of(const InformationState& state, Condensed& part) {
  for (const Condensed::Member& m : part.boundary) note_place(state, m.variable);
}

/// An element of the next zone is taken where its landmarks are now: with what it pulls there.
void CondensationTree::carry_element(const InformationState& state, Condensed& element) {
  note_places_of(state, element);
  if (!options_.turns || element.b == 0) return;
  const auto r = residual_of(element);
  list_places(element);
  boundary_.fit(near(), places_);
  element_mover_.carry(boundary_, places_, r, element);
}

/// What has come to the zone goes from the places of the plan to where its landmarks are now.
void CondensationTree::bring_zone() {
  boundary_.begin(near());
  for (int h = 0; h < zone_.size(); ++h)
    boundary_.add({.before = landmark(zone_.slot(h)).place, .now = zone_.mean(h)});
  boundary_.fit();
  zone_.bring(boundary_);
}

/// From now on the Jacobians of the window are taken where its landmarks are now.
void CondensationTree::carry_window(InformationState& state) {
  if (!options_.turns || !state.first_estimates().in_use()) return;
  carry_first_estimates(state, near(), boundary_);
  for (int h = 0; h < zone_.size(); ++h) state.first_estimates().set_point(zone_.slot(h), zone_.mean(h));
}

}  // namespace seif
