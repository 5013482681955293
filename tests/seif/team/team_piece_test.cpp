// How pieces of a map are coded, summed, and moved.
#include "seif/team/team_piece.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstddef>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace seif {
namespace {

/// How all coordinates move when the whole is moved and turned. (2m x 3)
Eigen::MatrixXd body_motions(const TeamPiece& piece) {
  Eigen::MatrixXd N(piece.r.size(), 3);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Eigen::Vector2d& p = piece.references[i];
    N.middleRows<2>(static_cast<Eigen::Index>(2 * i)) << 1.0, 0.0, -p.y(), 0.0, 1.0, p.x();
  }
  return N;
}

/// What is seen of landmarks from a place that nobody knows: no information about moving and turning.
TeamPiece random_piece(unsigned seed, int landmarks) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  TeamPiece piece;
  for (int i = 0; i < landmarks; ++i) {
    piece.landmarks.push_back(10 * i + 3);
    piece.references.emplace_back(1000.0 + 5.0 * normal(random), -300.0 + 5.0 * normal(random));
  }
  Eigen::MatrixXd V(2 * landmarks, 2 * landmarks);
  for (double& value : V.reshaped()) value = 30.0 * normal(random);
  piece.r = Eigen::VectorXd::Zero(2 * landmarks);
  const Eigen::MatrixXd N = body_motions(piece);
  const Eigen::MatrixXd across =
      Eigen::MatrixXd::Identity(N.rows(), N.rows()) - N * (N.transpose() * N).inverse() * N.transpose();
  piece.Omega = across * V * V.transpose() * across;
  Eigen::VectorXd step(2 * landmarks);
  for (double& value : step) value = 0.01 * normal(random);
  piece.r = piece.Omega * step;
  return piece;
}

TEST(TeamPiece, ComesBackFromItsBytesButForRounding) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TeamPiece piece = random_piece(seed, 4 + static_cast<int>(seed));
    const std::optional<TeamPiece> back = decode(encode(piece));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->landmarks, piece.landmarks);
    for (std::size_t i = 0; i < piece.size(); ++i)
      EXPECT_LT((back->references[i] - piece.references[i]).norm(), 1e-5);
    EXPECT_LT((back->Omega - piece.Omega).norm() / piece.Omega.norm(), 1e-2)
        << seed;  // the places that are told
    EXPECT_LT((back->r - piece.r).norm() / piece.r.norm(), 1e-2) << seed;
  }
}

TEST(TeamPiece, SaysNothingOfMovingAndTurningTheWholeAfterRounding) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TeamPiece back = decode(encode(random_piece(seed, 12))).value();
    Eigen::MatrixXd N = body_motions(back);
    N.col(2) -= N.leftCols<2>() * N.block<2, 1>(0, 2);  // turned about the first landmark
    EXPECT_LT((back.Omega * N).norm(), 1e-9 * back.Omega.norm() * N.norm()) << seed;
    EXPECT_LT((N.transpose() * back.r).norm(), 1e-9 * back.r.norm() * N.norm()) << seed;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(back.Omega).eigenvalues()(0),
              -1e-9 * back.Omega.norm());
  }
}

TEST(TeamPiece, GivesEachLandmarkAPlace) {
  TeamPiece piece = random_piece(3, 6);
  piece.Omega.setZero();
  piece.r.setZero();
  const TeamPiece back = decode(encode(piece)).value();
  const Eigen::VectorXd information =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(back.Omega).eigenvalues();
  EXPECT_GT(information(3), 0.1 / (told_place_sd * told_place_sd));  // all but the three motions of the whole
}

TEST(TeamPiece, IsSmall) {
  EXPECT_LE(encode(random_piece(1, 32)).size(), 32U * 280U);
  EXPECT_LE(encode(random_piece(1, 8)).size(), 8U * 90U);
}

TEST(TeamPiece, IsNotReadFromBytesThatWereCutOffOrAdded) {
  std::vector<std::byte> bytes = encode(random_piece(1, 5));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(decode(std::span(bytes).first(size))) << size;
  bytes.push_back({});
  EXPECT_FALSE(decode(bytes));
}

TEST(TeamPiece, MovesAsABody) {
  const TeamPiece piece = random_piece(1, 5);
  const Pose2 T{3.0, -2.0, 1.1};
  const TeamPiece there = moved(T, piece);
  EXPECT_LT((there.references[4] - T * piece.references[4]).norm(), 1e-12);
  const TeamPiece back = moved(inverse(T), there);
  EXPECT_LT((back.Omega - piece.Omega).norm(), 1e-9 * piece.Omega.norm());
  EXPECT_LT((back.r - piece.r).norm(), 1e-9 * piece.r.norm());
  EXPECT_NEAR(there.Omega.trace(), piece.Omega.trace(), 1e-9 * piece.Omega.trace());
}

}  // namespace
}  // namespace seif
