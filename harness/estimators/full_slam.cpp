#include "harness/estimators/full_slam.hpp"

#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "seif/models.hpp"

namespace harness {

namespace {

/// The smallest standard deviation of a motion in any direction. [m, rad]
///
/// The covariance of a motion may be singular: an increment of a differential drive has rank 2, because the
/// robot cannot slip sideways. The optimum then lies on a constraint, and this value says how tightly the
/// constraint is held. It allows 0.3 mm after ten thousand poses. The rounding of J' J is then 1e-6 of a
/// covariance; with a third of the value it would be 1e-5. A motion without any noise makes no pose of its
/// own (is_certain), so a robot at rest is exact.
constexpr double smallest_motion_sd = 3e-6;

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using RowMajor2 = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;

seif::Pose2 pose_of(const double* x) { return {x[0], x[1], x[2]}; }

Eigen::Vector3d vector_of(const seif::Pose2& pose) { return {pose.x, pose.y, pose.theta}; }

/// a - b, with the heading wrapped.
Eigen::Vector3d difference(const seif::Pose2& a, const seif::Pose2& b) {
  return {a.x - b.x, a.y - b.y, seif::wrap_angle(a.theta - b.theta)};
}

/// W with W' W = covariance^-1, for a positive definite covariance.
template <int n>
Eigen::Matrix<double, n, n> whitening(const Eigen::Matrix<double, n, n>& covariance) {
  using Square = Eigen::Matrix<double, n, n>;
  const Eigen::LLT<Square> llt(covariance);
  if (llt.info() != Eigen::Success)
    throw std::runtime_error(
        "batch: the covariance of the start or of an observation is not positive definite");
  return llt.matrixL().solve(Square::Identity());
}

/// The same for the covariance of a motion, which may have any rank.
Eigen::Matrix3d whitening_of_motion(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Vector3d sd =
      eigen.eigenvalues().cwiseMax(smallest_motion_sd * smallest_motion_sd).cwiseSqrt();
  return sd.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
}

/// The residual W (x_0 - start).
class StartCost final : public ceres::SizedCostFunction<3, 3> {
 public:
  explicit StartCost(const seif::PoseEstimate& start) : start_(start), W_(whitening(start.covariance)) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::Vector3d>{residuals} = W_ * difference(pose_of(parameters[0]), start_.mean);
    if (jacobians != nullptr && jacobians[0] != nullptr) Eigen::Map<RowMajor3>{jacobians[0]} = W_;
    return true;
  }

 private:
  seif::PoseEstimate start_;
  Eigen::Matrix3d W_;
};

/// The residual W (u_ij - u): the motion u_ij between two poses minus the measured motion u, in the frame of
/// the first pose. u_ij solves x_j = g(x_i, u_ij), so d u_ij = (dg/du)^-1 (d x_j - F d x_i), and dg/du is the
/// rotation by theta_i.
class MotionCost final : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit MotionCost(const seif::Odometry& motion)
      : measured_(motion.T_previous_current), W_(whitening_of_motion(motion.covariance)) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const seif::Pose2 T_world_i = pose_of(parameters[0]);
    seif::Odometry meant;
    meant.T_previous_current = inverse(T_world_i) * pose_of(parameters[1]);
    Eigen::Map<Eigen::Vector3d>{residuals} = W_ * difference(meant.T_previous_current, measured_);
    if (jacobians == nullptr) return true;
    RowMajor3 W_i = W_;  // W times the inverse rotation
    const Eigen::Rotation2Dd R_i_world(-T_world_i.theta);
    W_i.leftCols<2>() *= R_i_world.toRotationMatrix();
    if (jacobians[0] != nullptr)
      Eigen::Map<RowMajor3>{jacobians[0]} = -W_i * predict_pose(T_world_i, meant).J_wrt_pose;
    if (jacobians[1] != nullptr) Eigen::Map<RowMajor3>{jacobians[1]} = W_i;
    return true;
  }

 private:
  seif::Pose2 measured_;
  Eigen::Matrix3d W_;
};

/// The residual W (h(x, m) - z).
class SightingCost final : public ceres::SizedCostFunction<2, 3, 2> {
 public:
  explicit SightingCost(const Sighting& sighting)
      : sighting_(sighting), W_(whitening(sighting.observation.covariance)) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const seif::PredictedObservation predicted = seif::predict_observation(
        pose_of(parameters[0]), sighting_.T_pose_sensor, Eigen::Vector2d(parameters[1][0], parameters[1][1]));
    Eigen::Map<Eigen::Vector2d>{residuals} = -W_ * innovation(sighting_.observation, predicted.z);
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) Eigen::Map<RowMajor23>{jacobians[0]} = W_ * predicted.J_wrt_pose;
    if (jacobians[1] != nullptr) Eigen::Map<RowMajor2>{jacobians[1]} = W_ * predicted.J_wrt_landmark;
    return true;
  }

 private:
  const Sighting& sighting_;
  Eigen::Matrix2d W_;
};

/// True if the landmark may have been where the sensor is, as far as the measured range tells.
bool is_at_the_sensor(const seif::Observation& observation) {
  constexpr double far_enough = 4.0;  // [sigma]
  return observation.range < far_enough * std::sqrt(observation.covariance(0, 0));
}

/// The residual of a sighting at the sensor, in Cartesian coordinates: W (R p - [range 0]'), where p is the
/// landmark in the sensor's frame and R turns the measured bearing to the x axis. Range and bearing have no
/// derivative where the landmark meets the sensor, and the bearing jumps by half a turn behind it; the least sum
/// of squares may lie exactly there, and no search would converge. To the side, the standard deviation of the
/// bearing counts at the measured range, or at the range's own standard deviation if that is more.
class NearSightingCost final : public ceres::SizedCostFunction<2, 3, 2> {
 public:
  explicit NearSightingCost(const Sighting& sighting) : sighting_(sighting) {
    const seif::Observation& z = sighting.observation;
    const Eigen::Vector2d metres(1.0, std::max(z.range, std::sqrt(z.covariance(0, 0))));
    W_ = whitening<2>(metres.asDiagonal() * z.covariance * metres.asDiagonal());
    p_measured_ = {z.range, 0.0};
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const seif::Pose2 T_world_pose = pose_of(parameters[0]);
    const Eigen::Vector2d from_pose =
        Eigen::Vector2d(parameters[1][0], parameters[1][1]) - Eigen::Vector2d(T_world_pose.x, T_world_pose.y);
    const seif::Pose2& mount = sighting_.T_pose_sensor;
    const Eigen::Rotation2Dd R_pose_world(-T_world_pose.theta);
    const Eigen::Rotation2Dd R_z_pose(-mount.theta - sighting_.observation.bearing);
    const Eigen::Vector2d p_pose = R_pose_world * from_pose;
    Eigen::Map<Eigen::Vector2d>{residuals} =
        W_ * (R_z_pose * (p_pose - Eigen::Vector2d(mount.x, mount.y)) - p_measured_);
    if (jacobians == nullptr) return true;
    const Eigen::Matrix2d J = W_ * (R_z_pose * R_pose_world).toRotationMatrix();
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMajor23> J_pose{jacobians[0]};
      J_pose.leftCols<2>() = -J;
      J_pose.col(2) = W_ * (R_z_pose * Eigen::Vector2d(p_pose.y(), -p_pose.x()));
    }
    if (jacobians[1] != nullptr) Eigen::Map<RowMajor2>{jacobians[1]} = J;
    return true;
  }

 private:
  const Sighting& sighting_;
  Eigen::Matrix2d W_;
  Eigen::Vector2d p_measured_;
};

ceres::CostFunction* cost_of(const Sighting& sighting) {
  if (is_at_the_sensor(sighting.observation)) return new NearSightingCost(sighting);
  return new SightingCost(sighting);
}

/// The unknowns, in memory that Ceres modifies.
struct Unknowns {
  std::vector<Eigen::Vector3d> poses;
  std::vector<Eigen::Vector2d> landmarks;

  double* pose(int i) { return poses[static_cast<std::size_t>(i)].data(); }
  double* landmark(int i) { return landmarks[static_cast<std::size_t>(i)].data(); }
};

/// The loss of a sighting: a^2 log(1 + s / a^2) instead of s, where s is the squared norm of the residual.
ceres::LossFunction* loss_of(const FullSlam& slam) {
  return slam.robust_above > 0.0 ? new ceres::CauchyLoss(slam.robust_above) : nullptr;
}

void add_terms(const FullSlam& slam, Unknowns& unknowns, ceres::Problem& problem) {
  problem.AddResidualBlock(new StartCost(slam.start), nullptr, unknowns.pose(0));
  for (int i = 0; i + 1 < slam.pose_count(); ++i) {
    problem.AddResidualBlock(new MotionCost(slam.motions[static_cast<std::size_t>(i)]), nullptr,
                             unknowns.pose(i), unknowns.pose(i + 1));
  }
  for (const Sighting& sighting : slam.sightings) {
    problem.AddResidualBlock(cost_of(sighting), loss_of(slam), unknowns.pose(sighting.pose),
                             unknowns.landmark(sighting.landmark));
  }
}

/// Uses Gauss-Newton steps, and the damping of Levenberg-Marquardt only where such a step fails. Damping is
/// relative to the stiffest term of a pose, and some terms are constraints.
void minimise(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // the same bits whatever BLAS there is
  options.initial_trust_region_radius = options.max_trust_region_radius;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-12;  // [-] of the sum of squares: far below one standard deviation
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE)
    throw std::runtime_error("batch: no optimum was found: " + summary.message);
}

/// All unknowns; the rows are as in FullSlam.
ceres::Problem::EvaluateOptions all_of(Unknowns& unknowns) {
  ceres::Problem::EvaluateOptions options;
  for (Eigen::Vector3d& pose : unknowns.poses) options.parameter_blocks.push_back(pose.data());
  for (Eigen::Vector2d& landmark : unknowns.landmarks) options.parameter_blocks.push_back(landmark.data());
  return options;
}

/// The linearised terms: the lower triangle of J' J, and J' times the residuals.
struct NormalEquations {
  Eigen::SparseMatrix<double> Omega;
  Eigen::VectorXd gradient;
};

NormalEquations linearise(Unknowns& unknowns, ceres::Problem& problem) {
  ceres::CRSMatrix J;
  std::vector<double> gradient;
  if (!problem.Evaluate(all_of(unknowns), nullptr, nullptr, &gradient, &J))
    throw std::runtime_error("batch: the Jacobian at the optimum cannot be evaluated");
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> rows(
      J.num_rows, J.num_cols, static_cast<Eigen::Index>(J.values.size()), J.rows.data(), J.cols.data(),
      J.values.data());
  const Eigen::SparseMatrix<double> columns = rows;
  const Eigen::SparseMatrix<double> Omega = columns.transpose() * columns;
  return {Omega.triangularView<Eigen::Lower>(),
          Eigen::Map<const Eigen::VectorXd>(gradient.data(), static_cast<Eigen::Index>(gradient.size()))};
}

/// Takes Gauss-Newton steps near the optimum as long as they shrink, down to rounding. So the result does not
/// depend on where the search began. A solver that compares sums of squares cannot see steps this small.
/// Returns J' J.
Eigen::SparseMatrix<double> refine(Unknowns& unknowns, ceres::Problem& problem) {
  double before = std::numeric_limits<double>::infinity();
  while (true) {
    NormalEquations at = linearise(unknowns, problem);
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt(at.Omega);
    if (llt.info() != Eigen::Success) throw std::runtime_error("batch: the optimum is not a definite one");
    const Eigen::VectorXd step = -llt.solve(at.gradient);
    const double length = -at.gradient.dot(step);  // [-] squared, in standard deviations
    if (!(length < 0.5 * before)) return std::move(at.Omega);
    before = length;
    const double* next = step.data();
    for (Eigen::Vector3d& pose : unknowns.poses)
      pose += Eigen::Map<const Eigen::Vector3d>(std::exchange(next, next + 3));
    for (Eigen::Vector2d& landmark : unknowns.landmarks)
      landmark += Eigen::Map<const Eigen::Vector2d>(std::exchange(next, next + 2));
  }
}

}  // namespace

Eigen::Matrix3d information_of_motion(const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d W = whitening_of_motion(covariance);
  return W.transpose() * W;
}

bool is_certain(const seif::Odometry& motion) {
  return motion.covariance.trace() <= smallest_motion_sd * smallest_motion_sd;
}

std::vector<seif::Pose2> poses_on_map(const FullSlam& slam, std::span<const Eigen::Vector2d> landmarks) {
  std::vector<seif::Pose2> poses;
  poses.reserve(static_cast<std::size_t>(slam.pose_count()));
  seif::Odometry belief{0.0, slam.start.mean, slam.start.covariance};  // as a motion from the world's origin
  auto sighting = slam.sightings.begin();
  for (int i = 0; i < slam.pose_count(); ++i) {
    if (i > 0) belief = compose(belief, slam.motions[static_cast<std::size_t>(i - 1)]);
    const seif::Pose2 predicted_pose = belief.T_previous_current;
    Eigen::Matrix3d Omega = belief.covariance.inverse();
    Eigen::Vector3d r = Eigen::Vector3d::Zero();
    for (; sighting != slam.sightings.end() && sighting->pose == i; ++sighting) {
      const seif::PredictedObservation predicted = seif::predict_observation(
          predicted_pose, sighting->T_pose_sensor, landmarks[static_cast<std::size_t>(sighting->landmark)]);
      const seif::Matrix23 A = sighting->observation.covariance.inverse() * predicted.J_wrt_pose;
      Omega += A.transpose() * predicted.J_wrt_pose;
      r += A.transpose() * innovation(sighting->observation, predicted.z);
    }
    belief.covariance = Omega.inverse();
    const Eigen::Vector3d moved = vector_of(predicted_pose) + belief.covariance * r;
    belief.T_previous_current = {moved.x(), moved.y(), seif::wrap_angle(moved.z())};
    poses.push_back(belief.T_previous_current);
  }
  return poses;
}

FullSlamOptimum optimum(const FullSlam& slam, std::span<const seif::Pose2> poses,
                        std::span<const Eigen::Vector2d> landmarks) {
  Unknowns unknowns;
  for (const seif::Pose2& pose : poses) unknowns.poses.push_back(vector_of(pose));
  unknowns.landmarks.assign(landmarks.begin(), landmarks.end());
  ceres::Problem problem;
  add_terms(slam, unknowns, problem);
  minimise(problem);

  FullSlamOptimum result;
  result.Omega = refine(unknowns, problem);
  for (const Eigen::Vector3d& x : unknowns.poses)
    result.poses.push_back({x.x(), x.y(), seif::wrap_angle(x.z())});
  result.landmarks = unknowns.landmarks;
  return result;
}

}  // namespace harness
