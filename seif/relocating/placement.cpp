#include "seif/relocating/placement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

namespace seif {
namespace {

constexpr int fit_rounds = 4;            // [-] of Gauss-Newton
constexpr double agreement = 1e-6;       // [-] probability that right pairs are taken for wrong ones
constexpr double pose_agreement = 1e-6;  // [-] and that a pose that is right is forgotten

/// The pairs, linearised at a pose.
struct Linearised {
  Eigen::VectorXd v;                             // (2m)
  Eigen::Matrix<double, Eigen::Dynamic, 3> J_x;  // (2m x 3)
  Eigen::MatrixXd J_m;                           // (2m x 2m), block-diagonal
  Eigen::MatrixXd C;                             // (2m x 2m) of the surroundings
};

Linearised linearise(const LocalBelief& belief, const Pose2& T_world_robot, const Surroundings& surroundings,
                     const std::vector<Pairing>& pairs) {
  const auto m = static_cast<Eigen::Index>(pairs.size());
  Linearised all{Eigen::VectorXd(2 * m), Eigen::MatrixXd(2 * m, 3), Eigen::MatrixXd::Zero(2 * m, 2 * m),
                 Eigen::MatrixXd(2 * m, 2 * m)};
  for (Eigen::Index i = 0; i < m; ++i) {
    const Pairing& pair = pairs[static_cast<std::size_t>(i)];
    const ExpectedPlace expected = expect_place(T_world_robot, belief.mean_of(pair.landmark));
    all.v.segment<2>(2 * i) = surroundings.at(pair.around) - expected.p_robot;
    all.J_x.middleRows<2>(2 * i) = expected.J_x;
    all.J_m.block<2, 2>(2 * i, 2 * i) = expected.J_m;
    for (Eigen::Index j = 0; j < m; ++j) {
      all.C.block<2, 2>(2 * i, 2 * j) = surroundings.covariance.block<2, 2>(
          2 * static_cast<Eigen::Index>(pair.around),
          2 * static_cast<Eigen::Index>(pairs[static_cast<std::size_t>(j)].around));
    }
  }
  return all;
}

/// Of [pose | landmarks of the pairs]. (3+2m x 3+2m)
Eigen::MatrixXd covariance_of(const LocalBelief& belief, const std::vector<Pairing>& pairs) {
  std::vector<LandmarkId> ids;
  for (const Pairing& pair : pairs) ids.push_back(pair.landmark);
  const auto size = static_cast<Eigen::Index>(3 + 2 * pairs.size());
  Eigen::MatrixXd Sigma(size, size);
  belief.covariance_with(ids, Sigma);
  return Sigma;
}

std::size_t worst_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& S) {
  std::size_t worst = 0;
  double farthest = -1.0;
  for (Eigen::Index i = 0; i < residual.size(); i += 2) {
    const Eigen::Vector2d r = residual.segment<2>(i);
    const double distance = r.dot(Eigen::Matrix2d(S.block<2, 2>(i, i)).inverse() * r);
    if (distance <= farthest) continue;
    farthest = distance;
    worst = static_cast<std::size_t>(i / 2);
  }
  return worst;
}

}  // namespace

Surroundings surroundings_of(const LocalBelief& belief, const Pose2& T_world_robot,
                             std::vector<LandmarkId> ids) {
  const auto k = static_cast<Eigen::Index>(ids.size());
  Eigen::MatrixXd P(3 + 2 * k, 3 + 2 * k);
  belief.covariance_with(ids, P);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * k, 3 + 2 * k);
  Surroundings around{.landmarks = std::move(ids), .p_robot = Eigen::VectorXd(2 * k), .covariance = {}};
  for (Eigen::Index i = 0; i < k; ++i) {
    const ExpectedPlace place =
        expect_place(T_world_robot, belief.mean_of(around.landmarks[static_cast<std::size_t>(i)]));
    around.p_robot.segment<2>(2 * i) = place.p_robot;
    J.block<2, 3>(2 * i, 0) = place.J_x;
    J.block<2, 2>(2 * i, 3 + 2 * i) = place.J_m;
  }
  around.covariance = J * P * J.transpose();
  return around;
}

Pose2 pose_from(const Eigen::Vector2d& a_robot, const Eigen::Vector2d& b_robot,
                const Eigen::Vector2d& a_world, const Eigen::Vector2d& b_world) {
  const Eigen::Vector2d in_robot = b_robot - a_robot;
  const Eigen::Vector2d in_world = b_world - a_world;
  const double theta =
      wrap_angle(std::atan2(in_world.y(), in_world.x()) - std::atan2(in_robot.y(), in_robot.x()));
  const Eigen::Vector2d p =
      0.5 * (a_world + b_world) - Eigen::Rotation2Dd(theta) * Eigen::Vector2d(0.5 * (a_robot + b_robot));
  return {p.x(), p.y(), theta};
}

bool fit(const LocalBelief& belief, const Surroundings& surroundings, Placement& placement) {
  if (placement.pairs.size() < 2) return false;
  const auto m = static_cast<Eigen::Index>(placement.pairs.size());
  const Eigen::MatrixXd Sigma = covariance_of(belief, placement.pairs).bottomRightCorner(2 * m, 2 * m);
  for (int round = 0; round < fit_rounds; ++round) {
    Linearised all = linearise(belief, placement.T_world_robot, surroundings, placement.pairs);
    const Eigen::MatrixXd S = all.J_m * Sigma * all.J_m.transpose() + all.C;
    const Eigen::LLT<Eigen::MatrixXd> L(S);
    if (L.info() != Eigen::Success) return false;
    Eigen::Matrix<double, Eigen::Dynamic, 3> A = L.matrixL().solve(all.J_x);
    const Eigen::VectorXd b = L.matrixL().solve(all.v);
    const Eigen::Vector3d step = (A.transpose() * A).ldlt().solve(A.transpose() * b);
    if (!step.allFinite()) return false;
    Pose2& pose = placement.T_world_robot;
    pose = {pose.x + step(0), pose.y + step(1), wrap_angle(pose.theta + step(2))};
    placement.squared_distance = (b - A * step).squaredNorm();
    const Eigen::Matrix3d of_pose = A.transpose() * A;
    placement.log_density_of_poses =
        L.matrixLLT().diagonal().array().log().sum() + 0.5 * std::log(of_pose.determinant());
    placement.worst = worst_of(all.v - all.J_x * step, S);
  }
  return std::isfinite(placement.squared_distance);
}

bool fit_most(const LocalBelief& belief, const Surroundings& surroundings, std::size_t fewest,
              Placement& placement) {
  while (placement.pairs.size() >= fewest) {
    if (!fit(belief, surroundings, placement)) return false;
    const int degrees = 2 * static_cast<int>(placement.pairs.size()) - 3;
    if (placement.squared_distance <= chi_square_gate((degrees + 1) / 2, agreement)) return true;
    placement.pairs.erase(placement.pairs.begin() + static_cast<std::ptrdiff_t>(placement.worst));
  }
  return false;
}

Relocation relocation_to(const LocalBelief& belief, const Pose2& T_world_robot,
                         const Surroundings& surroundings, const Placement& placement,
                         const std::vector<LandmarkId>& names, const std::vector<bool>& is_used) {
  const double of_pose = squared_distance_from_belief(belief, T_world_robot, surroundings, placement.pairs) -
                         placement.squared_distance;
  Relocation relocation{.T_world_robot = placement.T_world_robot,
                        .surroundings = {},
                        .keeps_pose = of_pose <= chi_square_gate(2, pose_agreement)};
  std::vector<int> rows;
  for (std::size_t i = 0; i < surroundings.size(); ++i) {
    if (!is_used[i]) continue;
    relocation.surroundings.landmarks.push_back(names[i]);
    rows.insert(rows.end(), {2 * static_cast<int>(i), 2 * static_cast<int>(i) + 1});
  }
  relocation.surroundings.p_robot = surroundings.p_robot(rows);
  relocation.surroundings.covariance = surroundings.covariance(rows, rows);
  return relocation;
}

double squared_distance_from_belief(const LocalBelief& belief, const Pose2& T_world_robot,
                                    const Surroundings& surroundings, const std::vector<Pairing>& pairs) {
  const Linearised all = linearise(belief, T_world_robot, surroundings, pairs);
  Eigen::MatrixXd J(all.v.size(), 3 + all.v.size());
  J << all.J_x, all.J_m;
  const Eigen::LLT<Eigen::MatrixXd> L(J * covariance_of(belief, pairs) * J.transpose() + all.C);
  if (L.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  return L.matrixL().solve(all.v).squaredNorm();
}

}  // namespace seif
