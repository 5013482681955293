// What others have told, in the map of a filter with a condensation tree.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/information_state.hpp"
#include "seif/team/team_piece.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {

/// Holds references to parts of the filter that owns it.
class TreeNews {
 public:
  TreeNews(InformationState& state, CondensationTree& tree) : state_(state), tree_(tree) {}

  /// Whether news can be added now: the tree has no plan and no older news.
  bool is_welcome() const { return !tree_.is_busy(); }

  /// Before the first of some pieces.
  void begin() { settled_ = state_.landmark_count(); }

  /// Whether so many landmarks of the piece were in the map before, and so far apart, that they tell where the others
  /// are. Those that have joined since begin() do not count: placed from piece to piece, errors would add up.
  bool has_place_for(const TeamPiece& piece) const;

  /// Adds a piece for which there is a place. Landmarks that are not known join the map.
  void add(const TeamPiece& piece);

  /// After the last piece: from the next updates on, the tree spreads the news.
  void finish() { tree_.begin_news_plan(state_); }

  /// CondensationTree::broken_invariant().
  std::optional<std::string> broken_invariant() const { return tree_.broken_invariant(state_); }

 private:
  int join(const TeamPiece& piece, std::size_t i);

  InformationState& state_;
  CondensationTree& tree_;
  int settled_ = 0;  // [-] landmarks in the map before
  Eigen::Vector2d home_offset_ =
      Eigen::Vector2d::Zero();  // from where the known landmarks are to their homes [m]
  FrozenPiece frozen_;
  std::vector<Eigen::Vector2d> told_, known_;  // places [m]
};

}  // namespace seif
