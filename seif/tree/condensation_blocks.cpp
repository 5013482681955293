// All that is frozen, without the tree: what a sparse matrix of the whole map would hold. Off the live path.
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "seif/linearisation.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {
namespace {

/// Of a part over `slots`: S (2n x 2n) and r (2n).
void append(const std::vector<int>& slots, const Eigen::MatrixXd& S, const Eigen::VectorXd& r,
            FrozenInformation& all) {
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    all.r.segment<2>(Eigen::Index{2} * slots[k]) += r.segment<2>(row);
    for (std::size_t l = 0; l <= k; ++l)
      all.blocks.push_back({slots[k], slots[l], S.block<2, 2>(row, static_cast<Eigen::Index>(2 * l))});
  }
}

}  // namespace

FrozenInformation CondensationTree::frozen_information(const InformationState& state) const {
  FrozenInformation all{.blocks = {}, .r = Eigen::VectorXd::Zero(Eigen::Index{2} * state.landmark_count())};
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].own.b > 0) add_element(state, nodes_[i].own, all);
  }
  for (const FrozenPiece& piece : plan_.fresh.all()) {
    // A piece is an element of rank two.
    ArrayPool pool;
    Condensed element;
    for (const FrozenPiece::Member& m : piece.members) element.boundary.push_back({m.slot, 0});
    int row = 0;
    const auto index_of = [&](int slot) {
      for (row = 0; element.boundary[static_cast<std::size_t>(row)].variable != slot;) ++row;
      return row;
    };
    add_piece(piece, index_of, pool, element);
    add_element(state, element, all);
  }
  for (const Held& held : held_) {
    append({held.slot}, held_weight_ * Eigen::Matrix2d::Identity(),
           held_weight_ * (held.at - mean(state, held.slot)), all);
  }
  return all;
}

/// Where the Jacobians of the window are taken, so that it agrees with these about what turns everything.
void CondensationTree::add_element(const InformationState& state, const Condensed& element,
                                   FrozenInformation& all) const {
  std::vector<int> slots;
  std::vector<MovedPlace> means, points;
  const double* reference = element.reference.data();
  for (const Condensed::Member& m : element.boundary) {
    const Eigen::Vector2d now = mean(state, m.variable);
    const bool is_active = state.position(m.variable) >= 0;
    slots.push_back(m.variable);
    means.push_back(moved_place(m.variable, reference, now, 0.0));
    points.push_back(
        moved_place(m.variable, reference, is_active ? linearisation_point(state, m.variable) : now, 0.0));
    reference += 2;
  }
  Eigen::VectorXd d(element.b), r(element.b);
  Eigen::MatrixXd S(element.b, element.b);
  element.unpack(S);
  if (options_.turns) boundary_.fit(near(), means);
  for (std::size_t i = 0; i < means.size(); ++i) {
    d.segment<2>(static_cast<Eigen::Index>(2 * i)) =
        options_.turns ? boundary_.step(i) : Eigen::Vector2d(means[i].now - means[i].before);
  }
  element.residual(d, r);
  if (options_.turns) {
    boundary_.bring_residual(r);
    boundary_.fit(near(), points);
    boundary_.bring(S);
  }
  append(slots, S, r, all);
}

}  // namespace seif
