// What a part says where it is now, against finite differences and against what must never be learnt.
#include "seif/tree/step_jacobian.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "seif/tree/condensed.hpp"
#include "seif/tree/moved_boundary.hpp"

namespace seif {
namespace {

constexpr double part_near = 8.0;            // [m]
constexpr double jacobian_rounding = 1e-11;  // relative

/// A boundary that has moved, turned by some tenths of a radian, and bent.
struct Boundary {
  std::string name;
  int clusters;       // of five landmarks each, far from each other
  int single_points;  // far from all others
  int groups;
  double bend;  // [rad, m] by which clusters and groups have turned and moved apart
};

class OfABoundary : public testing::TestWithParam<Boundary> {
 protected:
  OfABoundary() : random_(7) {
    const Boundary& boundary = GetParam();
    for (int c = 0; c < boundary.clusters; ++c) {
      const Eigen::Vector2d middle = 60.0 * Eigen::Vector2d(c, normal());
      const double angle = 0.4 + boundary.bend * normal();
      const Eigen::Vector2d by = boundary.bend * Eigen::Vector2d(normal(), normal());
      for (int i = 0; i < 5; ++i) {
        const Eigen::Vector2d lever(normal(), normal());
        const Eigen::Vector2d strained = lever + 1e-3 * Eigen::Vector2d(normal(), normal());
        add({.before = middle + lever, .now = turned(middle) + by + Eigen::Rotation2Dd(angle) * strained});
      }
    }
    for (int i = 0; i < boundary.single_points; ++i) add(apart(i, false));
    for (int i = 0; i < boundary.groups; ++i) add(apart(10 + i, true));
  }

  double normal() { return normal_(random_); }
  static Eigen::Vector2d turned(const Eigen::Vector2d& p) {
    return Eigen::Rotation2Dd(0.4) * p + Eigen::Vector2d(3.0, -8.0);
  }
  MovedPlace apart(int i, bool is_group) {
    const Eigen::Vector2d p(40.0 * i, -70.0);
    const Eigen::Vector2d by = GetParam().bend * Eigen::Vector2d(normal(), normal());
    return {.before = p,
            .now = turned(p) + by,
            .turn = is_group ? 0.4 + GetParam().bend * normal() : 0.0,
            .dilation = is_group ? 0.01 * normal() : 0.0,
            .rows = is_group ? freedom(group_variable(0)) : 2};
  }
  void add(const MovedPlace& place) {
    rows_.push_back(size_);
    size_ += place.rows;
    places_.push_back(place);
  }

  /// d (n), in the frame of the body.
  Eigen::VectorXd steps(const std::vector<MovedPlace>& places) {
    moved_.fit({.near = part_near}, places);
    Eigen::VectorXd d(size_);
    moved_.steps(places, d);
    return d;
  }

  static double& unknown(MovedPlace& place, int row) {
    if (row < 2) return place.now(row);
    return row == 2 ? place.turn : place.dilation;
  }

  /// T (n x n) by central differences.
  Eigen::MatrixXd differences() {
    Eigen::MatrixXd T(size_, size_);
    constexpr double h = 1e-5;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      for (int k = 0; k < places_[i].rows; ++k) {
        std::vector<MovedPlace> plus = places_, minus = places_;
        unknown(plus[i], k) += h;
        unknown(minus[i], k) -= h;
        T.col(rows_[i] + k) = (steps(plus) - steps(minus)) / (2.0 * h);
      }
    }
    return T;
  }

  /// The motions of all, at the present places (n x 3).
  Eigen::MatrixXd motions() const {
    Eigen::MatrixXd N = Eigen::MatrixXd::Zero(size_, 3);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      N.block<2, 2>(rows_[i], 0).setIdentity();
      N.block<2, 1>(rows_[i], 2) << -places_[i].now.y(), places_[i].now.x();
      if (places_[i].is_turned()) N(rows_[i] + 2, 2) = 1.0;
    }
    return N;
  }

  /// Information that says nothing of the motions of all where the boundary was (n x n).
  Eigen::MatrixXd information() {
    Eigen::MatrixXd N = Eigen::MatrixXd::Zero(size_, 3);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      N.block<2, 2>(rows_[i], 0).setIdentity();
      N.block<2, 1>(rows_[i], 2) << -places_[i].before.y(), places_[i].before.x();
      if (places_[i].is_turned()) N(rows_[i] + 2, 2) = 1.0;
    }
    Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(size_, size_ + 3, [&] { return normal(); });
    A -= N * N.householderQr().solve(A);
    return A * A.transpose();
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<MovedPlace> places_;
  std::vector<int> rows_;
  int size_ = 0;
  MovedBoundary moved_;
};

INSTANTIATE_TEST_SUITE_P(StepJacobian, OfABoundary,
                         testing::Values(Boundary{"OneCluster", 1, 0, 0, 0.1},
                                         Boundary{"TwoClusters", 2, 0, 0, 0.1},
                                         Boundary{"SinglePoints", 0, 4, 0, 0.1},
                                         Boundary{"GroupsAndClusters", 2, 1, 3, 0.02},
                                         Boundary{"ManyClusters", 5, 3, 0, 0.3}),
                         [](const auto& boundary) { return boundary.param.name; });

/// Groups weigh in the turn of the whole by the cosine of their own, which the Jacobian takes as one.
TEST_P(OfABoundary, BringsTheResidualAsFiniteDifferencesDo) {
  Eigen::VectorXd r = Eigen::VectorXd::NullaryExpr(size_, [&] { return normal(); });
  const Eigen::MatrixXd shifts = motions().leftCols<2>();
  r -=
      shifts * shifts.transpose() * r / static_cast<double>(places_.size());  // no part pulls all to one side
  const Eigen::VectorXd expected = differences().transpose() * r;
  moved_.fit({.near = part_near}, places_);
  Eigen::VectorXd brought = r;
  moved_.bring_residual(brought);
  EXPECT_LT((brought - expected).norm(), (GetParam().groups > 0 ? 1e-3 : 1e-7) * expected.norm());
}

TEST_P(OfABoundary, BringsTheMatrixAsTheResidual) {
  const Eigen::MatrixXd S = information();
  moved_.fit({.near = part_near}, places_);
  Eigen::MatrixXd brought = S;
  moved_.bring(brought);
  Eigen::MatrixXd T_transposed = Eigen::MatrixXd::Identity(size_, size_);
  for (Eigen::Index k = 0; k < size_; ++k) {
    Eigen::VectorXd column = T_transposed.col(k);
    moved_.bring_residual(column);
    T_transposed.col(k) = column;
  }
  EXPECT_LT((brought - T_transposed * S * T_transposed.transpose()).norm(), jacobian_rounding * S.norm());
  EXPECT_LT((brought - brought.transpose()).norm(), jacobian_rounding * S.norm());
}

TEST_P(OfABoundary, SaysNothingOfMovingAndTurningAllWhereItIs) {
  const Eigen::MatrixXd S = information();
  moved_.fit({.near = part_near}, places_);
  Eigen::MatrixXd brought = S;
  moved_.bring(brought);
  EXPECT_LT((brought * motions()).norm(), 1e-9 * S.norm());
  EXPECT_GT((S * motions()).norm(), 1e-3 * S.norm());  // otherwise there was nothing to bring
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(brought).eigenvalues()(0),
            -jacobian_rounding * S.norm());
}

/// A long chain is stiff within its two ends and soft between them. Where the ends have been strained by millimetres,
/// it must stay as soft as it was: otherwise it learns how the one is turned against the other.
TEST(StepJacobian, LeavesAChainAsSoftAsItWas) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<MovedPlace> places;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector2d p(i < 5 ? 0.0 : 100.0, 0.0);
    const Eigen::Vector2d before = p + Eigen::Vector2d(normal(random), normal(random));
    places.push_back(
        {.before = before, .now = before + 1e-3 * Eigen::Vector2d(normal(random), normal(random))});
  }
  // What the clusters' own motions cost (6 x 6), and all that strains them.
  constexpr double soft = 1e-3, stiff = 1e6;
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(20, 6), rigid_now = rigid;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Index col = i < 5 ? 0 : 3;
    const Eigen::Vector2d middle(i < 5 ? 0.0 : 100.0, 0.0);
    const auto set = [&](Eigen::MatrixXd& N, const Eigen::Vector2d& p) {
      N.block<2, 2>(2 * i, col).setIdentity();
      N.block<2, 1>(2 * i, col + 2) << -(p - middle).y(), (p - middle).x();
    };
    set(rigid, places[static_cast<std::size_t>(i)].before);
    set(rigid_now, places[static_cast<std::size_t>(i)].now);
  }
  const Eigen::MatrixXd onto_rigid = rigid * rigid.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::MatrixXd onto_strain = Eigen::MatrixXd::Identity(20, 20) - onto_rigid;
  Eigen::Matrix<double, 3, 6> relative;  // of the second end, in the frame of the first
  relative << -1, 0, 0, 1, 0, 0, 0, -1, -100, 0, 1, 0, 0, 0, -1, 0, 0, 1;
  const Eigen::MatrixXd of_ends = relative * rigid.completeOrthogonalDecomposition().pseudoInverse();
  Eigen::MatrixXd S = stiff * onto_strain.transpose() * onto_strain + soft * of_ends.transpose() * of_ends;
  const Eigen::MatrixXd before = rigid.transpose() * S * rigid;
  MovedBoundary moved;
  moved.fit({.near = part_near}, places);
  moved.bring(S);
  const Eigen::MatrixXd now = rigid_now.transpose() * S * rigid_now;
  EXPECT_LT((now - before).norm(), 1e-4 * before.norm());
  EXPECT_LT(std::abs(now(2, 2) - before(2, 2)), 1e-4 * before(2, 2));
  EXPECT_LT(std::abs(now(5, 5) - before(5, 5)), 1e-2 * before(5, 5));
}

}  // namespace
}  // namespace seif
