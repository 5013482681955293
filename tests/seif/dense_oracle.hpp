// The information filter in dense form, straight from the report's equations. It inverts the whole matrix where
// the report does so. It is the reference for the block-sparse steps. Here the report's names are used: H for
// Omega, b for xi.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <random>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/models.hpp"
#include "seif/types.hpp"

namespace seif::oracle {

struct DenseBelief {
  Eigen::MatrixXd H;   // information matrix (n x n)
  Eigen::VectorXd b;   // information vector (n x 1)
  Eigen::VectorXd mu;  // the mean that the filter believes in; H^-1 b only after exact recovery (n x 1)
};

Eigen::MatrixXd symmetric(const Eigen::SparseMatrix<double>& lower);

DenseBelief dense(const InformationState& state);

/// M^-1 and M^-1 v. Compiled once, since Eigen's factorisations take seconds to compile in each file that uses
/// one.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& M);
Eigen::VectorXd solve(const Eigen::MatrixXd& M, const Eigen::VectorXd& v);  // M symmetric

/// mu = H^-1 b, eq. (10).
void recover_mean(DenseBelief& belief);

void recover_mean(InformationState& state);

Pose2 pose_of(const DenseBelief& belief);

/// Eqs. (33), (34) as printed, through the covariance.
void motion_update(DenseBelief& belief, const Odometry& odometry);

/// Adds a landmark without information.
void add_landmark(DenseBelief& belief, const Eigen::Vector2d& mean);

/// Eqs. (21), (22).
void measurement_update(DenseBelief& belief, int slot, const Observation& observation,
                        const Pose2& T_robot_sensor);

/// The columns of the identity (n x n) for the robot, if `robot`, and for landmark slots: the report's S.
Eigen::MatrixXd projection(Eigen::Index n, bool robot, const std::vector<int>& slots);

/// H S (S' H S)^-1 S' H: the matrix that is subtracted when S is marginalised out.
Eigen::MatrixXd taken_away(const Eigen::MatrixXd& H, const Eigen::MatrixXd& S);

/// The belief over robot and active landmarks from which the report takes p(x | Y+): conditioned on Y- = 0, eq.
/// (47).
Eigen::MatrixXd conditioned(const Eigen::MatrixXd& H, const std::vector<int>& active);

/// The same with Y- marginalised out: Eustice's modified rule.
Eigen::MatrixXd marginalised(const Eigen::MatrixXd& H, const std::vector<int>& active);

/// The belief conditioned on Y- = 0, without its information about position and heading of the whole: H0 with
/// its rigid-body modes removed, written down from the definition.
Eigen::MatrixXd floated(const Eigen::MatrixXd& H, const Eigen::VectorXd& mu, const std::vector<int>& active);

/// Eq. (50), with `H0` the belief over robot and active landmarks, and `dropped` the slots of Y0.
Eigen::MatrixXd sparsified(const Eigen::MatrixXd& H, const Eigen::MatrixXd& H0,
                           const std::vector<int>& dropped);

/// A drive through random landmarks, which gives passive landmarks and links between them: the initial states
/// of the tests.
struct RandomDrive {
  explicit RandomDrive(unsigned seed) : random(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }

  Odometry odometry();
  Observation observation(LandmarkId landmark, const Pose2& T_world_sensor, const Eigen::Vector2d& p_world);

  std::mt19937_64 random;
};

}  // namespace seif::oracle
