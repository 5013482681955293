// How Seif keeps its mean right: what an update asks for, in the order in which it asks.
//
//   scan -> activate -> before_information -> (information is added) -> solve_window -> join
//        -> after_information -> (sparsification) -> deactivate -> end_update
//
// Three implementations stand side by side: TreeMean (tree/), GroupMean (groups/) and ExactMean.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/window_factor.hpp"

namespace seif {

class MeanKeeper {
 public:
  virtual ~MeanKeeper() = default;

  /// Before a scan is taken in: moves the landmarks `slots` into the window, with their present means. Takes
  /// those out of `slots` that have to wait. `range`: of the farthest observation [m]. False if a matrix is
  /// not positive definite.
  [[nodiscard]] virtual bool activate(InformationState& state, std::vector<int>& slots, double range) = 0;

  /// Before and after the information of a scan is added; all known landmarks that it sees are active. False if
  /// a matrix is not positive definite.
  [[nodiscard]] virtual bool before_information(const InformationState& /*state*/) { return true; }
  [[nodiscard]] virtual bool after_information(const InformationState& /*state*/) { return true; }

  /// The mean of robot and active landmarks, given what is known of the others. May be called often in one
  /// update. False if a matrix is not positive definite.
  [[nodiscard]] virtual bool solve_window(InformationState& state) = 0;

  /// A landmark has just joined the map; it is not active yet.
  virtual void join(const InformationState& state, int slot) = 0;

  /// These landmarks have left the window. False if a matrix is not positive definite.
  [[nodiscard]] virtual bool deactivate(const InformationState& /*state*/, std::span<const int> /*slots*/) {
    return true;
  }

  /// The last step of an update: recovers the mean of the others as far as this implementation does. False
  /// if a matrix is not positive definite.
  [[nodiscard]] virtual bool end_update(InformationState& state) = 0;

  /// p_world_landmark as it is now. [m]
  virtual Eigen::Vector2d mean(const InformationState& state, int slot) const = 0;

  /// The Cholesky factor of the last solve_window(), L L' = (Omega + what is known of all others), if L takes
  /// in all of Omega: then (L L')^-1 is the covariance of the window. Null otherwise. (w x w), lower triangle
  virtual const WindowFactor* window_factor() const { return nullptr; }

  /// Blocks read or written so far. [-]
  virtual std::int64_t blocks_touched() const = 0;
  /// Counts::mean_residual, where it is known.
  virtual std::optional<double> residual() const { return std::nullopt; }
  virtual std::size_t memory_bytes() const = 0;
};

}  // namespace seif
