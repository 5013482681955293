// A part of the map, brought to where its variables are now: with what it says, and how it pulls, there.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "seif/tree/condensed.hpp"
#include "seif/tree/moved_boundary.hpp"

namespace seif {

class MovedPart {
 public:
  /// Where a part has the step d(p) of its boundary at the places p, and T = dd/dp: T' S T and T' (s - S d).
  void bring(const Turning& turning, std::span<const MovedPlace> places, const Condensed& part);

  /// Of the last one: the lower triangle by column, as Condensed has it, and the residual (b).
  const double* S() const { return packed_.data(); }
  const double* r() const { return r_.data(); }
  std::size_t memory_bytes() const {
    return sizeof(double) * static_cast<std::size_t>(square_.size() + packed_.size() + d_.size() + r_.size());
  }

 private:
  MovedBoundary boundary_;
  Eigen::VectorXd square_, packed_, d_, r_;  // with room to grow
};

}  // namespace seif
