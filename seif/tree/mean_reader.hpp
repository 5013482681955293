// Reads means: what was eliminated at a node, or tied there, follows the boundary of its message.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "seif/tree/condensation_records.hpp"

namespace seif {

class MeanReader {
 public:
  explicit MeanReader(const CondensationRecords& records) : records_(records) {}

  /// What was settled at this node. The means of the boundary must be known already.
  void read(int at, Means means);

  std::int64_t blocks_touched() const { return blocks_touched_; }

 private:
  BodyMotion find_step(const Condensed& message, Means means);
  void set(FrontVariable v, Means means, const GroupMotion& mean, const BodyMotion& motion) const;

  const CondensationRecords& records_;
  std::vector<MovedPlace> places_;
  MovedBoundary boundary_;
  Eigen::VectorXd step_;  // of E and B, with room to grow
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
