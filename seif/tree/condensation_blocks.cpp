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

/// Where the Jacobians of the window are taken, so that it agrees with these about what turns everything.
void add_element(const CondensationTree& tree, const InformationState& state, const Turning& turning,
                 const Condensed& element, FrozenInformation& all) {
  std::vector<int> slots;
  std::vector<MovedPlace> means, points;
  const double* reference = element.reference.data();
  for (const Condensed::Member& m : element.boundary) {
    const Eigen::Vector2d before(reference[0], reference[1]);
    const Eigen::Vector2d now = tree.mean(state, m.variable);
    const bool is_active = state.position(m.variable) >= 0;
    slots.push_back(m.variable);
    means.push_back({.before = before, .now = now});
    points.push_back({.before = before, .now = is_active ? linearisation_point(state, m.variable) : now});
    reference += 2;
  }
  Eigen::VectorXd d(element.b), r(element.b);
  Eigen::MatrixXd S(element.b, element.b);
  element.unpack(S);
  MovedBoundary boundary;
  boundary.fit(turning, means);
  boundary.steps(means, d);
  element.residual(d, r);
  boundary.bring_residual(r);
  boundary.fit(turning, points);
  boundary.bring(S);
  append(slots, S, r, all);
}

}  // namespace

FrozenInformation CondensationTree::frozen_information(const InformationState& state) const {
  FrozenInformation all{.blocks = {}, .r = Eigen::VectorXd::Zero(Eigen::Index{2} * state.landmark_count())};
  for (std::size_t i = 0; i < records_.nodes.size(); ++i) {
    if (records_.nodes[i].own.b > 0)
      add_element(*this, state, records_.turning(), records_.nodes[i].own, all);
  }
  for (const FrozenPiece& piece : plan_.fresh.all()) {
    // A piece is an element.
    ArrayPool pool;
    Condensed element;
    for (const FrozenPiece::Member& m : piece.members) element.boundary.push_back({m.slot, 0});
    int row = 0;
    const auto index_of = [&](int slot) {
      for (row = 0; element.boundary[static_cast<std::size_t>(row)].variable != slot;) ++row;
      return row;
    };
    add_piece(piece, index_of, pool, element);
    add_element(*this, state, records_.turning(), element, all);
  }
  for (std::size_t i = 0; i < held_.slots.size(); ++i) {
    const int slot = held_.slots[i];
    append({slot}, held_.weight * Eigen::Matrix2d::Identity(),
           held_.weight * (held_.at[i] - mean(state, slot)), all);
  }
  return all;
}

}  // namespace seif
