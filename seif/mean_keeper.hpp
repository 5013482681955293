// How Seif keeps its mean up to date: the calls of an update, in their order.
//
//   scan -> activate -> before_information -> (information is added) -> solve_window -> join
//        -> after_information -> (sparsification) -> freeze -> end_update
//
// There are three implementations: TreeMean (tree/), GroupMean (groups/) and ExactMean.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/information_state.hpp"
#include "seif/window_factor.hpp"

namespace seif {

class MeanKeeper {
 public:
  virtual ~MeanKeeper() = default;

  /// Called before a scan is taken in. Moves the landmarks `slots` into the window, with their present means.
  /// Removes from `slots` the landmarks that have to wait. `range`: of the farthest observation [m]. False if a
  /// matrix is not positive definite.
  [[nodiscard]] virtual bool activate(InformationState& state, std::vector<int>& slots, double range) = 0;

  /// Called before and after the information of a scan is added. All known landmarks that the scan sees are
  /// active then. False if a matrix is not positive definite.
  [[nodiscard]] virtual bool before_information(const InformationState& /*state*/) { return true; }
  [[nodiscard]] virtual bool after_information(const InformationState& /*state*/) { return true; }

  /// Computes the mean of robot and active landmarks, given what is known of the other landmarks. May be called
  /// several times in one update. False if a matrix is not positive definite.
  [[nodiscard]] virtual bool solve_window(InformationState& state) = 0;

  /// Called when a landmark has just joined the map. It is not active yet.
  virtual void join(const InformationState& state, int slot) = 0;

  /// Called when landmarks have left the window, with what was frozen with them, if the state keeps that apart.
  /// False if a matrix is not positive definite.
  [[nodiscard]] virtual bool freeze(const InformationState& /*state*/, const FrozenPiece& /*piece*/) {
    return true;
  }

  /// The last step of an update: recovers the mean of the other landmarks, as far as this implementation does
  /// so. False if a matrix is not positive definite.
  [[nodiscard]] virtual bool end_update(InformationState& state) = 0;

  /// The mean of a landmark now, p_world_landmark. [m]
  virtual Eigen::Vector2d mean(const InformationState& state, int slot) const = 0;

  /// The Cholesky factor L (w x w, lower triangle) of the last solve_window(), L L' = Omega + what is known of
  /// all other landmarks, if L takes all of Omega into account. Then (L L')^-1 is the covariance of the window.
  /// Null otherwise.
  virtual const WindowFactor* window_factor() const { return nullptr; }

  /// Blocks read or written so far. [-]
  virtual std::int64_t blocks_touched() const = 0;
  /// Counts::mean_residual, if this implementation knows it.
  virtual std::optional<double> residual() const { return std::nullopt; }
  virtual std::size_t memory_bytes() const = 0;
};

}  // namespace seif
