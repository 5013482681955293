// What one robot tells the others: what it has learnt of a part of the map.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "seif/types.hpp"

namespace seif {

/// The sum of what a robot has frozen (freezing.hpp) over some updates. It holds no information about moving and turning
/// all of its landmarks, so it holds in whichever frame they are. Each piece is told once, and holds measurements that no
/// other piece has: whoever adds each piece once counts nothing twice.
struct TeamPiece {
  std::vector<LandmarkId> landmarks;        // m of them
  std::vector<Eigen::Vector2d> references;  // where the teller had them, in its own frame [m]
  Eigen::MatrixXd Omega;                    // (2m x 2m)
  Eigen::VectorXd r;                        // (2m) the residual at the reference

  std::size_t size() const { return landmarks.size(); }
};

/// How firmly a piece holds its landmarks where the teller had them, among each other: so a landmark has a place although
/// most of what is known of it is still in the teller's window and comes with a later piece. [m]
inline constexpr double told_place_sd = 1.0;

/// The bytes of a piece, about 4 (2m + 6) for each landmark. The piece needs two landmarks or more, at different places.
/// What is coded is the triangular factor of Omega without the rows of three coordinates, in single precision. So what
/// rounding changes is no information about moving and turning the whole, and the matrix stays positive semidefinite.
std::vector<std::byte> encode(const TeamPiece& piece);

/// Nothing if the bytes are no piece.
std::optional<TeamPiece> decode(std::span<const std::byte> bytes);

/// The same piece where its landmarks are at T times their places.
TeamPiece moved(const Pose2& T, const TeamPiece& piece);

}  // namespace seif
