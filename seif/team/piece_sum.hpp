// Sums up what a robot freezes until it is told.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/information_state.hpp"
#include "seif/team/team_piece.hpp"

namespace seif {

class PieceSum {
 public:
  /// `most`: landmarks of a sum [-]; a single piece may have more.
  explicit PieceSum(std::size_t most) : most_(most) {}

  bool is_empty() const { return ids_.empty(); }
  /// Whether a piece can be added: the sum stays small enough, and the map has not bent since the sum began.
  bool has_room_for(const FrozenPiece& piece, const InformationState& state) const;
  void add(const FrozenPiece& piece, const InformationState& state);

  /// What is to be told, without the start points; then the sum is empty. Nothing if it says nothing to others.
  std::optional<TeamPiece> take();

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t index_of(LandmarkId id) const;

  std::size_t most_;
  std::vector<LandmarkId> ids_;
  std::vector<Eigen::Vector2d> references_;  // [m]
  Eigen::MatrixXd Omega_;                    // (2n x 2n) of the n landmarks, with room to grow
  Eigen::VectorXd r_;                        // (2n) likewise
};

}  // namespace seif
