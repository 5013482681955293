// What finding out which landmark is seen asks of a filter with known correspondence: its belief over the
// landmarks that can be told of in bounded work.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/association/association.hpp"
#include "seif/estimator.hpp"

namespace seif {

class AssociableFilter : public Estimator {
 public:
  /// Before the belief is asked for, after all motions. May throw NumericalFailure.
  virtual void begin_association(double t) = 0;

  /// The landmarks that are at hand; replaces what `out` held.
  virtual void landmarks_at_hand(std::vector<LandmarkId>& out) const = 0;
  virtual bool is_at_hand(LandmarkId landmark) const = 0;

  // Of landmarks at hand:

  /// p_world_landmark. [m]
  virtual Eigen::Vector2d mean_of(LandmarkId landmark) const = 0;
  /// Linearised as the measurement update would do it.
  virtual ExpectedObservation expect(LandmarkId landmark, const Observation& observation) const = 0;
  /// The filter's own covariance of [pose | landmarks], to `out` (3+2m x 3+2m).
  virtual void covariance_with(std::span<const LandmarkId> landmarks,
                               Eigen::Ref<Eigen::MatrixXd> out) const = 0;

  /// Whether nothing is ever learned of where in the world all of it lies: then the start's uncertainty is
  /// part of every covariance, as one motion of robot and map.
  virtual bool keeps_start_uncertainty() const { return false; }

  /// Others that ought to be at hand soon.
  virtual void want(std::span<const LandmarkId> /*landmarks*/) {}

  /// With the next scan, and if they are at hand then: these two are one landmark. One of them is not to be
  /// observed from then on.
  virtual void equate(LandmarkId a, LandmarkId b) = 0;
};

/// How far two landmarks that are one may lie apart. An information filter cannot represent zero. [m]
inline constexpr double equal_sd = 1e-3;

}  // namespace seif
