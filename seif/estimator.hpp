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
#include <string_view>
#include <vector>

#include "seif/counts.hpp"
#include "seif/types.hpp"

namespace seif {

class LocalBelief;
class TeamMember;

/// The parts of an update that are timed separately. A filter without one of these parts never reports it.
enum class Stage { motion, measurement, sparsification, mean_recovery };

/// Called by a filter when a stage of its update has ended. The caller may read a clock; the filter does not.
using StageDone = std::function<void(Stage)>;

/// What an estimator is made from.
struct EstimatorSetup {
  PoseEstimate start;      // drawn from N(truth, P0); the covariance is positive definite
  Pose2 T_robot_sensor;    // where the landmark sensor sits
  std::mt19937_64 random;  // the filter's own random stream
};

/// A landmark of the map.
struct LandmarkEstimate {
  LandmarkId landmark = no_landmark;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // p_world_landmark [m]
};

/// Marginal covariances of the pose, and of the landmarks that were asked for, in the order asked for.
struct MarginalCovariances {
  Eigen::Matrix3d pose = Eigen::Matrix3d::Zero();  // (3 x 3) [m, rad]
  std::vector<Eigen::Matrix2d> landmarks;          // (2 x 2) each [m^2]
};

/// A group of landmarks whose joint covariance is asked for.
using LandmarkIds = std::vector<LandmarkId>;

/// Which matrix a filter stores.
enum class BeliefMatrix { none, information, covariance };

/// An off-diagonal block of that matrix, in the row of a landmark or of the robot.
struct Coupling {
  LandmarkId other = no_landmark;  // no_landmark: the robot
  double strength = 0.0;           // [-] in [0, 1]: largest |M_ab| / sqrt(M_aa M_bb) of its entries
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

  /// The live path. An update consists of all calls of motion_update since the last scan, and then one
  /// measurement_update.
  virtual void motion_update(const Odometry& odometry) = 0;

  /// Takes in a scan, and does everything that follows (sparsification, mean recovery). A scan may be empty.
  /// Landmarks never seen before join the map. Calls `done` after each stage. May throw NumericalFailure.
  virtual void measurement_update(const Scan& scan, const StageDone& done) = 0;

  /// Whether every observation must name its landmark. False for a filter with data association.
  virtual bool needs_names() const { return true; }

  /// For a filter with data association: the landmark of its map to which it assigned each observation of the
  /// latest scan, in the order of the scan; no_landmark: the observation was ignored. Empty for other filters:
  /// they use the landmark that the observation names.
  virtual std::span<const LandmarkId> associations() const { return {}; }

  /// The interface that data association needs (association/local_belief.hpp). Null: the filter cannot provide
  /// it in bounded work, so its observations must name their landmarks.
  virtual LocalBelief* local_belief() { return nullptr; }

  /// The interface that exchange with other robots needs (team/team_member.hpp). Null: the filter exchanges nothing.
  virtual TeamMember* team_member() { return nullptr; }

  /// T_world_robot as the filter believes it now.
  virtual Pose2 pose() const = 0;

  /// The covariance of the pose, if the filter can tell it in constant time; otherwise nothing.
  virtual std::optional<Eigen::Matrix3d> pose_covariance() const { return std::nullopt; }

  virtual Counts counts() const = 0;

  /// Memory of the filter's state. [byte]
  virtual std::size_t memory_bytes() const = 0;

  /// The means of those of `landmarks` that are in the map, in the order asked for; any order is allowed.
  /// Replaces the content of `out`. A filter whose work does not grow with the map does this in O(log N) for
  /// each landmark. The default costs a whole map().
  virtual void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const;

  /// Which matrix couplings() reads.
  virtual BeliefMatrix belief_matrix() const { return BeliefMatrix::none; }

  /// The off-diagonal blocks that are not zero in the row of a landmark, or of the robot (no_landmark), in any
  /// order. Empty for a landmark that is not in the map. Replaces the content of `out`. The work grows only
  /// with the length of that row.
  virtual void couplings(LandmarkId /*of*/, std::vector<Coupling>& out) const { out.clear(); }

  /// Off the live path, at any cost: the whole matrix of belief_matrix(), with rows [x y theta | landmarks in
  /// the order of map()]. (3+2N x 3+2N), symmetric; empty for BeliefMatrix::none. `seif` leaves
  /// the uncertainty of the start out of it (start_frame).
  virtual Eigen::MatrixXd whole_belief_matrix() const { return {}; }

  /// Off the live path, at any cost: the whole map, in the order in which the landmarks joined it.
  virtual std::vector<LandmarkEstimate> map() const = 0;

  /// Off the live path, at any cost: marginal covariances of the filter's own belief. Nothing if the belief is
  /// not a proper Gaussian (an information matrix that is not positive definite), or if the filter has no
  /// covariance. Each of `landmarks` must be in the map.
  virtual std::optional<MarginalCovariances> marginal_covariances(
      std::span<const LandmarkId> landmarks) const = 0;

  /// The joint covariance of the pose and the landmarks of each group, with rows [x y theta m1x m1y m2x ...] in
  /// the order of the group. A landmark may stand in a group twice. (3+2k x 3+2k) each. The default returns
  /// nothing.
  virtual std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const LandmarkIds> /*groups*/) const {
    return std::nullopt;
  }

  /// Changes an option from the next motion on. `value` is in the option's range. False: this filter cannot
  /// change it while it runs; nothing has changed then.
  virtual bool change_option(std::string_view /*option*/, double /*value*/) { return false; }
};

}  // namespace seif
