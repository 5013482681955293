// Recovers the mean from the information form: section 3.2 of the report.
#pragma once

#include <Eigen/Core>
#include <random>

#include "seif/information_state.hpp"

namespace seif {

/// How a filter recovers its mean at the end of an update.
enum class MeanRecovery {
  coordinate_descent,  // PlainSeif: the report's method, in constant time
  multilevel,          // Seif: rigid groups of landmarks (groups/): approaches the exact mean, least memory
  tree,                // Seif: condensation tree (tree/), exact in corridors, nearly so in large areas
  exact                // sparse Cholesky: exact, not in constant time
};

/// The report's coordinate descent, eqs. (42), (43), Lemma 4. It sets one coordinate after the other to its
/// optimum with all others held: once for every active landmark, for `random_landmarks` (the report's K) drawn
/// from the whole map, and for the robot. In residual form a coordinate's step is Omega_ii^-1 r_i. The robot
/// comes last, so that r_x = 0 afterwards. False if a diagonal block turns out not to be positive definite; the
/// mean then keeps the steps made so far.
[[nodiscard]] bool coordinate_descent(InformationState& state, int random_landmarks, std::mt19937_64& random);

/// Replaces a residual d of robot and active landmarks by the step of their mean that makes it zero, with all
/// other landmarks held: d = Omega_ww^-1 d over the window (w x 1). False, with d unchanged, if Omega_ww is not
/// positive definite.
[[nodiscard]] bool solve_for_window(InformationState& state, Eigen::Ref<Eigen::VectorXd> d);

/// The exact mean, eq. (37): moves the mean by Omega^-1 r, with sparse Cholesky. Not in constant time. False,
/// with the mean unchanged, if Omega is not positive definite.
[[nodiscard]] bool solve_mean(InformationState& state);

}  // namespace seif
