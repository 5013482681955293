// The whole belief of an information state, off the live path: each function makes a pass over the map. Rows
// are [x y theta m1x m1y ...], with the landmarks in the order of their slots.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "seif/information_state.hpp"

namespace seif {

Eigen::SparseMatrix<double> full_Omega(const InformationState& state);  // (3+2N x 3+2N), lower triangle
Eigen::VectorXd full_mu(const InformationState& state);                 // (3+2N x 1)
/// The entries of Omega() alone, in the rows of all landmarks; lower triangle.
std::vector<Eigen::Triplet<double>> window_entries(const InformationState& state);
Eigen::VectorXd full_r(const InformationState& state);  // (3+2N x 1)

/// Moves the whole mean by d (3+2N x 1), for instance by the exact solution of Omega d = r.
void move_all(InformationState& state, const Eigen::VectorXd& d);

}  // namespace seif
