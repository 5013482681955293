// The belief over the landmarks near the robot, in bounded work, for data association.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/association/association.hpp"
#include "seif/relocating/surroundings.hpp"
#include "seif/types.hpp"

namespace seif {

/// Filters that can compute it return this from Estimator::local_belief().
class LocalBelief {
 public:
  virtual ~LocalBelief() = default;

  /// To be called before the other functions, after all motions. May throw NumericalFailure.
  virtual void begin_association(double t) = 0;

  /// The landmarks at hand: those whose belief the filter can compute now. Replaces the content of `out`.
  virtual void landmarks_at_hand(std::vector<LandmarkId>& out) const = 0;
  virtual bool is_at_hand(LandmarkId landmark) const = 0;

  // For landmarks at hand:

  /// p_world_landmark. [m]
  virtual Eigen::Vector2d mean_of(LandmarkId landmark) const = 0;
  /// Linearised as the measurement update would do it.
  virtual ExpectedObservation expect(LandmarkId landmark, const Observation& observation) const = 0;
  /// The filter's own covariance of [pose | landmarks], to `out` (3+2m x 3+2m). A filter that estimates in
  /// the frame of its start leaves out the uncertainty of the start: it changes no expected observation.
  virtual void covariance_with(std::span<const LandmarkId> landmarks,
                               Eigen::Ref<Eigen::MatrixXd> out) const = 0;

  /// Asks that these landmarks be at hand soon.
  virtual void want(std::span<const LandmarkId> /*landmarks*/) {}

  /// These two are one landmark: the filter joins them with the next scan, if both are at hand then. From
  /// then on only one of them may be observed.
  virtual void equate(LandmarkId a, LandmarkId b) = 0;

  /// Has these landmarks at hand at once, at the cost of a whole plan for the next zone. False if a matrix is not
  /// positive definite.
  [[nodiscard]] virtual bool bring(std::span<const LandmarkId> /*landmarks*/) { return true; }

  /// The filter puts the robot there with the next scan, in place of what it would do otherwise. The known landmarks of
  /// the relocation are at hand.
  virtual void relocate(const Relocation& relocation) = 0;
};

/// The standard deviation with which two landmarks that are one are held together: an information filter
/// cannot represent zero. [m]
inline constexpr double equal_sd = 1e-3;

}  // namespace seif
