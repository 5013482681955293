#include "seif/team/team_piece.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "seif/team/bytes.hpp"

namespace seif {
namespace {

constexpr std::size_t most_landmarks = 4096;  // [-] of a piece

// Three coordinates say where the whole is: both of the first landmark, and one of the landmark farthest from it. The
// others move with them as
//   d_others = F d_base   when the whole is moved and turned,
// so Omega = [-F 1]' Omega_others [-F 1].
struct Base {
  std::array<Eigen::Index, 3> rows;
  std::vector<Eigen::Index> others;  // (2m-3)
  Eigen::MatrixXd F;                 // (2m-3 x 3)
};

/// How each coordinate moves when the whole is moved, and turned about the first landmark. (2m x 3)
Eigen::MatrixXd body_motions(std::span<const Eigen::Vector2d> places) {
  Eigen::MatrixXd N(2 * static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d lever = places[i] - places.front();
    N.middleRows<2>(static_cast<Eigen::Index>(2 * i)) << 1.0, 0.0, -lever.y(), 0.0, 1.0, lever.x();
  }
  return N;
}

Base base_of(std::span<const Eigen::Vector2d> places) {
  const auto farthest = std::ranges::max_element(
      places, {}, [&](const Eigen::Vector2d& p) { return (p - places.front()).squaredNorm(); });
  const Eigen::Vector2d lever = *farthest - places.front();
  const Eigen::Index row =
      2 * (farthest - places.begin()) + (std::abs(lever.x()) > std::abs(lever.y()) ? 1 : 0);
  Base base{.rows = {0, 1, row}, .others = {}, .F = {}};
  const Eigen::MatrixXd N = body_motions(places);
  for (Eigen::Index k = 2; k < N.rows(); ++k) {
    if (k != row) base.others.push_back(k);
  }
  const Eigen::Matrix3d of_base = N(base.rows, Eigen::all);
  base.F = N(base.others, Eigen::all) * of_base.inverse();
  return base;
}

Eigen::Vector2d rounded(const Eigen::Vector2d& p) { return p.cast<float>().cast<double>(); }

}  // namespace

std::vector<std::byte> encode(const TeamPiece& piece) {
  std::vector<std::byte> bytes;
  ByteWriter to(bytes);
  const Eigen::Vector2d origin = piece.references.front();
  to.put(static_cast<std::uint16_t>(piece.size()));
  to.put(origin.x());
  to.put(origin.y());
  std::vector<Eigen::Vector2d> places;
  Eigen::VectorXd step(piece.r.size());  // from the reference to what is coded
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Eigen::Vector2d p = piece.references[i] - origin;
    places.push_back(rounded(p));
    step.segment<2>(static_cast<Eigen::Index>(2 * i)) = places[i] - p;
    to.put(static_cast<std::uint32_t>(piece.landmarks[i]));
    to.put(static_cast<float>(p.x()));
    to.put(static_cast<float>(p.y()));
  }
  const Base base = base_of(places);
  Eigen::MatrixXd Omega = piece.Omega(base.others, base.others);
  Omega.diagonal().array() += 1.0 / (told_place_sd * told_place_sd);
  const Eigen::LLT<Eigen::MatrixXd> llt(Omega);
  const Eigen::MatrixXd L = llt.matrixL();
  const Eigen::VectorXd y = llt.matrixL().solve((piece.r - piece.Omega * step)(base.others));
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    for (Eigen::Index i = j; i < L.rows(); ++i) to.put(static_cast<float>(L(i, j)));
  }
  for (const double value : y) to.put(static_cast<float>(value));
  return bytes;
}

std::optional<TeamPiece> decode(std::span<const std::byte> bytes) {
  ByteReader from(bytes);
  const std::size_t m = from.get<std::uint16_t>();
  const std::size_t rows = 2 * m - 3;
  constexpr std::size_t head = sizeof(std::uint16_t) + 2 * sizeof(double);
  constexpr std::size_t each = sizeof(std::uint32_t) + 2 * sizeof(float);
  if (m < 2 || m > most_landmarks ||
      bytes.size() != head + m * each + (rows * (rows + 1) / 2 + rows) * sizeof(float))
    return std::nullopt;
  TeamPiece piece;
  const double x = from.get_double();
  const double y = from.get_double();
  for (std::size_t i = 0; i < m; ++i) {
    piece.landmarks.push_back(static_cast<LandmarkId>(from.get<std::uint32_t>()));
    const double along = from.get_float();
    piece.references.emplace_back(along, from.get_float());
  }
  const Base base = base_of(piece.references);
  const auto n = static_cast<Eigen::Index>(rows);
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(m), n);  // Omega = V V'
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) V(base.others[static_cast<std::size_t>(i)], j) = from.get_float();
  }
  Eigen::VectorXd residual(n);
  for (double& value : residual) value = from.get_float();
  V(base.rows, Eigen::all) = -base.F.transpose() * V(base.others, Eigen::all);
  piece.Omega = V * V.transpose();
  piece.r = V * residual;
  for (Eigen::Vector2d& p : piece.references) p += Eigen::Vector2d(x, y);
  if (!V.allFinite() || !residual.allFinite() || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  return piece;
}

TeamPiece moved(const Pose2& T, const TeamPiece& piece) {
  TeamPiece there = piece;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T.theta).toRotationMatrix();
  for (Eigen::Vector2d& p : there.references) p = T * p;
  for (Eigen::Index i = 0; i < there.r.size(); i += 2) {
    there.r.segment<2>(i) = R * piece.r.segment<2>(i);
    for (Eigen::Index j = 0; j < there.r.size(); j += 2)
      there.Omega.block<2, 2>(i, j) = R * piece.Omega.block<2, 2>(i, j) * R.transpose();
  }
  return there;
}

}  // namespace seif
