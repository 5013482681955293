// The whole belief of an estimator at the end of a run, with the truth, and the network of its links.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "harness/run/live_loop.hpp"
#include "harness/score/score.hpp"

namespace harness {

/// Matrices are (3+2N x 3+2N), [x y theta | landmarks], with the landmarks in the order in which they joined
/// the map.
struct Belief {
  std::string estimator;  // name of the estimator
  PosePair pose;
  std::vector<PointPair> landmarks;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd information;
};

/// Reads the belief. Throws std::runtime_error if the estimator has failed, has no matrix or no positive
/// definite one, or if its map has a landmark that the world does not have.
Belief belief_of(const LiveEstimator& estimator, std::span<const TrueLandmark> truth,
                 const seif::Pose2& true_pose);

/// |M_ij| / sqrt(M_ii M_jj). For a covariance these are the absolute correlations. The diagonal of `M` is
/// positive.
Eigen::MatrixXd normalised(const Eigen::MatrixXd& M);

inline constexpr int robot = -1;  // in the place of a landmark's number

/// A block of the information matrix that is not zero.
struct NetworkLink {
  int from = robot;       // number of a landmark in the belief, or the robot
  int to = 0;             // number of a landmark, larger than `from`
  double strength = 0.0;  // [-] in (0, 1]: its largest normalised entry
};

/// All links between landmarks and to the robot, the weakest first. `normalised_information` is (3+2N x
/// 3+2N).
std::vector<NetworkLink> links_of(const Eigen::MatrixXd& normalised_information);

}  // namespace harness
