// All that is frozen, for tests and for reading the whole belief.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace seif {

/// All that is frozen: blocks of pairs of landmarks, of which one pair may have several, and the residual (2N).
struct FrozenInformation {
  struct Block {
    int slot, other;
    Eigen::Matrix2d Omega;
  };
  std::vector<Block> blocks;
  Eigen::VectorXd r;
};

}  // namespace seif
