// Jacobians at first estimates: against a dense implementation of the rule, and what the filter does not learn
// because of them.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "dense_oracle.hpp"
#include "driven_state.hpp"
#include "seif/full_state.hpp"
#include "seif/information_state.hpp"
#include "seif/linearisation.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/measurement_steps.hpp"
#include "seif/motion_update.hpp"
#include "seif/observation_factor.hpp"
#include "seif/sparsification.hpp"

namespace seif {
namespace {

using oracle::RandomDrive;
using test::relative;
using test::T_robot_sensor;

/// The heading is almost unknown, so that any information gained about it shows.
const PoseEstimate vague_start{.mean = {0.1, -0.2, 0.3},
                               .covariance = Eigen::Vector3d(0.01, 0.02, 0.1).asDiagonal().toDenseMatrix()};

/// A robot on a circle of 2 m inside a circle of ten landmarks. It sees those within 4 m.
class World {
 public:
  explicit World(unsigned seed) : random_(seed) {}

  Odometry advance() {
    Odometry u{.t = 0.0, .T_previous_current = {0.3, 0.0, 0.15}, .covariance = random_.odometry().covariance};
    truth_ = truth_ * u.T_previous_current;
    u.T_previous_current.x += random_.uniform(-0.03, 0.03);
    u.T_previous_current.theta += random_.uniform(-0.03, 0.03);
    return u;
  }

  std::vector<Observation> scan() {
    std::vector<Observation> scan;
    const Pose2 T_world_sensor = truth_ * T_robot_sensor;
    for (int k = 0; k < 10; ++k) {
      const Eigen::Vector2d p(5.0 * std::cos(0.63 * k), 2.0 + 5.0 * std::sin(0.63 * k));
      if ((inverse(T_world_sensor) * p).norm() > 4.0) continue;
      scan.push_back(random_.observation(k, T_world_sensor, p));
    }
    return scan;
  }

 private:
  Pose2 truth_ = vague_start.mean;
  RandomDrive random_;
};

/// Takes in one scan as the filter does: the known landmarks, the exact mean, then the new landmarks from
/// there. `again`: the known ones are then linearised once more, at the corrected pose.
void take_in(InformationState& state, const std::vector<Observation>& scan, bool again = false) {
  state.begin_scan();
  std::vector<ObservationFactor> factors;
  for (const Observation& z : scan) {
    const auto slot = state.find(z.landmark);
    if (slot) factors.push_back(linearise(state, *slot, z, T_robot_sensor));
  }
  for (const ObservationFactor& factor : factors) {
    add(state, factor);
    state.mark_seen(factor.slot);
  }
  ASSERT_TRUE(solve_mean(state));
  if (again && !factors.empty()) {
    subtract_all(state, factors);
    follow_pose(state, factors.front().x0);
    add_again(state, T_robot_sensor, factors);
    ASSERT_TRUE(solve_mean(state));
  }
  for (const Observation& z : scan) {
    if (state.find(z.landmark)) continue;
    const int slot =
        state.add_landmark(z.landmark, invert_observation(state.pose(), T_robot_sensor, z).p_world_landmark);
    add(state, linearise(state, slot, z, T_robot_sensor));
    state.mark_seen(slot);
  }
  update_first_estimates(state);
}

/// The same filter in dense form, with covariances and an exact mean, so that xi = Omega mu.
struct DenseFirstEstimates {
  int settled_after;
  Eigen::MatrixXd Omega = vague_start.covariance.inverse();
  Eigen::VectorXd mu = Eigen::Vector3d(vague_start.mean.x, vague_start.mean.y, vague_start.mean.theta);
  Eigen::VectorXd at = mu;     // linearisation points: predicted pose, first estimates
  std::vector<int> ids = {};   // by slot
  std::vector<int> seen = {};  // scans, by slot

  Pose2 pose() const { return {mu(0), mu(1), mu(2)}; }

  void motion(const Odometry& u) {
    const PredictedPose predicted = predict_pose(pose(), u);
    const Pose2 carried = Pose2{at(0), at(1), at(2)} * (inverse(pose()) * predicted.pose);
    const auto n = Omega.rows();
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(n, n);
    mu.head<3>() << predicted.pose.x, predicted.pose.y, predicted.pose.theta;
    const Eigen::Vector3d to = pose_among_first_estimates(carried);
    F(0, 2) = -(to(1) - at(1));
    F(1, 2) = to(0) - at(0);
    Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(n, n);
    noise.topLeftCorner<3, 3>() = predicted.noise_factor * predicted.noise_factor.transpose();
    Omega = oracle::inverse(F * oracle::inverse(Omega) * F.transpose() + noise);
    at.head<3>() = to;
  }

  /// The pose after the rigid motion that brings the means of the landmarks to their first estimates. All
  /// landmarks are near.
  Eigen::Vector3d pose_among_first_estimates(const Pose2& carried) const {
    const auto landmarks = static_cast<Eigen::Index>(ids.size());
    if (landmarks < 2) return {carried.x, carried.y, carried.theta};
    const auto points = [&](const Eigen::VectorXd& all) {
      return Eigen::MatrixXd(Eigen::Map<const Eigen::Matrix2Xd>(all.data() + 3, 2, landmarks));
    };
    const Eigen::Matrix3d T = Eigen::umeyama(points(mu), points(at), false);
    Eigen::Vector3d there = T * Eigen::Vector3d(mu(0), mu(1), 1.0);
    there(2) = wrap_angle(mu(2) + std::atan2(T(1, 0), T(0, 0)));
    return there;
  }

  /// J' at the mean (n x 2), except that turning everything about the robot turns the first estimates.
  Eigen::MatrixXd slopes(int slot) const {
    const int row = InformationState::row_of(slot);
    const PredictedObservation there = predict_observation(pose(), T_robot_sensor, mu.segment<2>(row));
    const Eigen::Vector2d lever = at.segment<2>(row) - at.head<2>();
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(Omega.rows(), 2);
    C.topRows<3>() = there.J_wrt_pose.transpose();
    C.middleRows<2>(row) = there.J_wrt_landmark.transpose();
    C.row(2) = lever.y() * C.row(row) - lever.x() * C.row(row + 1);
    return C;
  }

  void measurement(const std::vector<Observation>& scan) {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(Omega.rows());
    std::vector<Observation> unknown;
    for (const Observation& z : scan) {
      const auto found = std::ranges::find(ids, z.landmark);
      if (found == ids.end()) {
        unknown.push_back(z);
        continue;
      }
      const int slot = static_cast<int>(found - ids.begin());
      const Eigen::MatrixXd C = slopes(slot);
      const Eigen::Vector2d m = mu.segment<2>(InformationState::row_of(slot));
      const Eigen::Vector2d v = innovation(z, predict_observation(pose(), T_robot_sensor, m).z);
      Omega += C * z.covariance.inverse() * C.transpose();
      r += C * z.covariance.inverse() * v;
      ++seen[static_cast<std::size_t>(slot)];
    }
    mu += oracle::solve(Omega, r);
    mu(2) = wrap_angle(mu(2));
    for (const Observation& z : unknown) add_new(z);
    for (std::size_t slot = 0; slot < ids.size(); ++slot) {
      const int row = InformationState::row_of(static_cast<int>(slot));
      if (seen[slot] <= settled_after) move_first_estimate(row, among_first_estimates(mu.segment<2>(row)));
    }
  }

  /// Changes variables, so that turning everything has the same effect on Omega about the new first estimates
  /// as before about the old ones.
  void move_first_estimate(int row, const Eigen::Vector2d& to) {
    const Eigen::Vector2d by = to - at.segment<2>(row);
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(Omega.rows(), Omega.rows());
    T.block<2, 1>(row, 2) << by.y(), -by.x();
    Omega = (T.transpose() * Omega * T).eval();
    at.segment<2>(row) = to;
  }

  Eigen::Vector2d among_first_estimates(const Eigen::Vector2d& p) const {
    return at.head<2>() + p - mu.head<2>();
  }

  void add_new(const Observation& z) {
    const auto n = Omega.rows();
    const Eigen::Vector2d p = invert_observation(pose(), T_robot_sensor, z).p_world_landmark;
    Omega.conservativeResizeLike(Eigen::MatrixXd::Zero(n + 2, n + 2));
    mu.conservativeResize(n + 2);
    at.conservativeResize(n + 2);
    mu.tail<2>() = p;
    at.tail<2>() = among_first_estimates(p);
    const Eigen::MatrixXd C = slopes(static_cast<int>(ids.size()));
    Omega += C * z.covariance.inverse() * C.transpose();
    ids.push_back(z.landmark);
    seen.push_back(1);
  }
};

class FirstEstimates : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(SettledAfter, FirstEstimates, testing::Values(1, 3));

TEST_P(FirstEstimates, EqualTheRuleWrittenDownDensely) {
  World world(7);
  InformationState state(vague_start);
  state.first_estimates().settle_after(GetParam());
  DenseFirstEstimates dense{.settled_after = GetParam()};
  for (int k = 0; k < 30; ++k) {
    const Odometry u = world.advance();
    motion_update(state, u);
    dense.motion(u);
    const std::vector<Observation> scan = world.scan();
    take_in(state, scan);
    dense.measurement(scan);
    ASSERT_LT(relative(oracle::symmetric(full_Omega(state)), dense.Omega), 1e-9) << "step " << k;
    ASSERT_LT((full_mu(state) - dense.mu).norm(), 1e-9) << "step " << k;
  }
  EXPECT_GT((dense.mu - dense.at).norm(), 1e-3);  // first estimates are not means
}

InformationState driven(unsigned seed, int steps, int first_estimates, bool again = false) {
  World world(seed);
  InformationState state(vague_start);
  if (first_estimates > 0) state.first_estimates().settle_after(first_estimates);
  for (int k = 0; k < steps; ++k) {
    motion_update(state, world.advance());
    take_in(state, world.scan(), again);
  }
  return state;
}

/// The points at which the steps linearise (3+2N x 1).
Eigen::VectorXd linearisation_points(const InformationState& state) {
  Eigen::VectorXd at = full_mu(state);
  const Pose2 point = linearisation_pose(state);
  at.head<3>() << point.x, point.y, point.theta;
  for (int slot = 0; slot < state.landmark_count(); ++slot) {
    at.segment<2>(InformationState::row_of(slot)) = linearisation_point(state, slot);
  }
  return at;
}

/// Both translations, and the rotation about the world's origin, at one set of points (3+2N x 3). Motions carry
/// these modes along, and observations do not see them.
Eigen::MatrixXd rigid_modes(const Eigen::VectorXd& at) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(at.size(), 3);
  P.topRows<3>() << 1, 0, -at(1), 0, 1, at(0), 0, 0, 1;
  for (Eigen::Index row = 3; row < at.size(); row += 2) {
    P.middleRows<2>(row) << 1, 0, -at(row + 1), 0, 1, at(row);
  }
  return P;
}

/// The information about the rigid-body modes, divided by that of the start: the largest of three ratios.
double gained(const InformationState& state) {
  const Eigen::VectorXd at = linearisation_points(state);
  const Eigen::MatrixXd P = rigid_modes(at);
  const Eigen::MatrixXd P_start =
      rigid_modes(Eigen::Vector3d(vague_start.mean.x, vague_start.mean.y, vague_start.mean.theta));
  const Eigen::Matrix3d now = P.transpose() * oracle::symmetric(full_Omega(state)) * P;
  const Eigen::Matrix3d at_start = P_start.transpose() * vague_start.covariance.inverse() * P_start;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(now, at_start).eigenvalues().maxCoeff();
}

double heading_variance(const InformationState& state) {
  return oracle::inverse(oracle::symmetric(full_Omega(state)))(2, 2);
}

// Nothing observes where in the world the map lies, nor how it is turned. Motion noise reduces what the start
// knew of this, and no scan may add to it.
TEST(FirstEstimates, LearnNothingOfPlaceAndHeadingOfTheMapWhereJacobiansAtTheMeanDo) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    for (const int settled_after : {1, 5}) {
      const InformationState first_estimates = driven(seed, 60, settled_after);
      EXPECT_LT(gained(first_estimates), 1.0 + 1e-8);
      EXPECT_GT(heading_variance(first_estimates), vague_start.covariance(2, 2));
    }

    const InformationState at_the_mean = driven(seed, 60, 0);
    EXPECT_GT(gained(at_the_mean), 1.5);
    EXPECT_LT(heading_variance(at_the_mean), 0.9 * vague_start.covariance(2, 2));
  }
}

// The pose's first estimate follows the pose then, and Omega follows the first estimate.
TEST(FirstEstimates, LearnNothingOfPlaceAndHeadingWhereScansAreLinearisedAgain) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    const InformationState state = driven(seed, 60, 5, true);
    EXPECT_LT(gained(state), 1.0 + 1e-8);
    EXPECT_GT(heading_variance(state), vague_start.covariance(2, 2));
  }
}

TEST(FirstEstimates, GaugeFreeSparsificationFloatsTheWindowByTheModesWhereItWasLinearised) {
  InformationState state = driven(3, 20, 1);
  const Eigen::MatrixXd before = oracle::symmetric(full_Omega(state));
  std::vector<int> active;
  for (int position = 0; position < state.active_count(); ++position)
    active.push_back(state.active(position));
  const Eigen::MatrixXd at_points = oracle::floated(before, linearisation_points(state), active);
  const Eigen::MatrixXd at_mean = oracle::floated(before, full_mu(state), active);
  std::vector<int> dropped;
  choose_to_drop(state, DropOrder::least_recently_seen, state.active_count() - 3, dropped);
  ASSERT_TRUE(sparsify(state, SparsificationRule::gauge_free, dropped));
  const Eigen::MatrixXd after = oracle::symmetric(full_Omega(state));
  EXPECT_LT(relative(after, oracle::sparsified(before, at_points, dropped)), 1e-8);  // inverses
  EXPECT_GT(relative(after, oracle::sparsified(before, at_mean, dropped)), 1e-6);
}

}  // namespace
}  // namespace seif
