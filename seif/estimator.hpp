// The interface that the harness drives: what a user's own filter implements.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "seif/counts.hpp"
#include "seif/types.hpp"

namespace seif {

class LocalBelief;

/// The parts of an update that are timed apart. A filter that lacks one never reports it.
enum class Stage { motion, measurement, sparsification, mean_recovery };

/// Called by a filter when a stage of its update has ended. The caller may read a clock; the filter does not.
using StageDone = std::function<void(Stage)>;

/// What an estimator is born with.
struct EstimatorSetup {
  PoseEstimate start;      // drawn from N(truth, P0); the covariance is positive definite
  Pose2 T_robot_sensor;    // where the landmark sensor sits
  std::mt19937_64 random;  // the filter's own stream, for those that draw
};

/// A landmark of the map.
struct LandmarkEstimate {
  LandmarkId landmark = no_landmark;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // p_world_landmark [m]
};

/// Marginal covariances: of the pose, and of each landmark that was asked for, in that order.
struct MarginalCovariances {
  Eigen::Matrix3d pose = Eigen::Matrix3d::Zero();  // (3 x 3) [m, rad]
  std::vector<Eigen::Matrix2d> landmarks;          // (2 x 2) each [m^2]
};

/// Landmarks whose covariance with each other is asked for.
using LandmarkIds = std::vector<LandmarkId>;

/// What a filter keeps of how things go together.
enum class BeliefMatrix { none, information, covariance };

/// An off-diagonal block of that matrix.
struct Coupling {
  LandmarkId other = no_landmark;  // no_landmark: the robot
  double strength = 0.0;           // [-] in [0, 1]: the largest |M_ab| / sqrt(M_aa M_bb) in it
};

/// Thrown by a filter whose belief is no longer a proper Gaussian: it has diverged or lost its precision.
class NumericalFailure : public std::runtime_error {
 public:
  NumericalFailure(const std::string& stage, double t)
      : std::runtime_error(stage + " at t = " + std::to_string(t) + " s: a matrix is not positive definite") {
  }
};

/// A SLAM filter, driven with one stream of odometry and scans in the order of time.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// The live path. An update is every motion_update since the last scan, and then one measurement_update.
  virtual void motion_update(const Odometry& odometry) = 0;

  /// Takes in a scan, and does all that follows (sparsification, mean recovery). A scan may be empty.
  /// Landmarks never seen before join the map. Calls `done` after each stage. May throw NumericalFailure.
  virtual void measurement_update(const Scan& scan, const StageDone& done) = 0;

  /// Whether every observation must name its landmark. A filter that finds out by itself says no.
  virtual bool needs_names() const { return true; }

  /// Of a filter that finds out by itself: which landmark of its map it took each observation of the latest
  /// scan for, in their order; no_landmark: left out. Empty of others: what the observation says.
  virtual std::span<const LandmarkId> associations() const { return {}; }

  /// What data association asks for (association/local_belief.hpp). Null: the filter cannot tell it in bounded
  /// work, and associations must be known.
  virtual LocalBelief* local_belief() { return nullptr; }

  /// T_world_robot as now believed.
  virtual Pose2 pose() const = 0;

  /// The covariance of the pose where the filter has it at hand, in constant time; otherwise nothing.
  virtual std::optional<Eigen::Matrix3d> pose_covariance() const { return std::nullopt; }

  virtual Counts counts() const = 0;

  /// What the filter's state occupies. [byte]
  virtual std::size_t memory_bytes() const = 0;

  /// The means of those of `landmarks` that are in the map, in the order asked for, which may be any;
  /// replaces what `out` held. Filters whose work does not grow with the map do this in O(log N) for each; by
  /// default it costs a whole map().
  virtual void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const;

  /// Which matrix couplings() tells of.
  virtual BeliefMatrix belief_matrix() const { return BeliefMatrix::none; }

  /// The off-diagonal blocks that are not zero in the row of a landmark, or of the robot (no_landmark); none
  /// for a landmark that is not in the map. Replaces what `out` held; in any order. The work grows with the
  /// length of that row alone.
  virtual void couplings(LandmarkId /*of*/, std::vector<Coupling>& out) const { out.clear(); }

  /// Off the live path, at any cost: that matrix whole, [x y theta | landmarks in the order of map()].
  /// (3+2N x 3+2N), symmetric; empty for BeliefMatrix::none.
  virtual Eigen::MatrixXd whole_belief_matrix() const { return {}; }

  /// Off the live path, at any cost: the whole map, in the order in which the landmarks joined it.
  virtual std::vector<LandmarkEstimate> map() const = 0;

  /// Off the live path, at any cost: marginals of the filter's own belief. Nothing if that is not a proper
  /// Gaussian (an information matrix that is not positive definite), or if the filter has none.
  /// Each of `landmarks` must be in the map.
  virtual std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const = 0;

  /// The same of the pose together with the landmarks of each group, [x y theta m1x m1y m2x ...] in the order
  /// of the group, in which one may stand twice. (3+2k x 3+2k) each. By default the filter does not tell.
  virtual std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> /*groups*/) const {
    return std::nullopt;
  }
};

}  // namespace seif
