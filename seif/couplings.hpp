// What Estimator::couplings() tells, from the two ways in which our filters keep their matrix. Reads one row
// of it, and changes and counts nothing.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/information_state.hpp"
#include "seif/landmark_index.hpp"

namespace seif {

/// Of the block-sparse matrix: no more work than the landmark has links, or the window blocks.
void couplings_of(const InformationState& state, LandmarkId of, std::vector<Coupling>& out);

/// Of a dense matrix M of [x y theta m1x m1y ...] (3+2N x 3+2N), of which the lower triangle is read; `ids`
/// by slot (N). O(N).
void couplings_of(const Eigen::Ref<const Eigen::MatrixXd>& M, const LandmarkIndex& index,
                  std::span<const LandmarkId> ids, LandmarkId of, std::vector<Coupling>& out);

}  // namespace seif
