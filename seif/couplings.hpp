// Implements Estimator::couplings() for the two ways in which our filters store their matrix. Reads one row of
// the matrix, and changes and counts nothing.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/information_state.hpp"
#include "seif/landmark_index.hpp"

namespace seif {

/// From the block-sparse matrix. The work grows with the number of the landmark's links, or of the window's
/// blocks.
void couplings_of(const InformationState& state, LandmarkId of, std::vector<Coupling>& out);

/// From a dense matrix M of [x y theta m1x m1y ...] (3+2N x 3+2N). Only the lower triangle is read. `ids`: the
/// landmarks by slot (N). O(N).
void couplings_of(const Eigen::Ref<const Eigen::MatrixXd>& M, const LandmarkIndex& index,
                  std::span<const LandmarkId> ids, LandmarkId of, std::vector<Coupling>& out);

}  // namespace seif
