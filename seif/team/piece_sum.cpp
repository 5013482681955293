#include "seif/team/piece_sum.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "seif/start_points.hpp"

namespace seif {
namespace {

/// A landmark that has moved farther than this many standard deviations of a sighting has moved with a closure. [-]
constexpr double most_sigmas = 3.0;
constexpr double least_spread = 0.01;  // [m] of the landmarks of a piece

Eigen::Index row_of(std::size_t index) { return static_cast<Eigen::Index>(2 * index); }

}  // namespace

std::size_t PieceSum::index_of(LandmarkId id) const {
  const auto found = std::ranges::find(ids_, id);
  return found == ids_.end() ? none : static_cast<std::size_t>(found - ids_.begin());
}

bool PieceSum::has_room_for(const FrozenPiece& piece, const InformationState& state) const {
  if (is_empty()) return true;
  std::size_t landmarks = ids_.size();
  const double most_step = most_sigmas * state.first_estimates().sighting_sd();
  for (const FrozenPiece::Member& member : piece.members) {
    const std::size_t i = index_of(state.id(member.slot));
    if (i == none) {
      ++landmarks;
    } else if ((member.reference - references_[i]).norm() > most_step) {
      return false;
    }
  }
  return landmarks <= most_;
}

void PieceSum::add(const FrozenPiece& piece, const InformationState& state) {
  std::vector<std::size_t> at;
  for (const FrozenPiece::Member& member : piece.members) {
    std::size_t i = index_of(state.id(member.slot));
    if (i == none) {
      i = ids_.size();
      ids_.push_back(state.id(member.slot));
      references_.push_back(member.reference);
    }
    at.push_back(i);
  }
  const auto rows = row_of(ids_.size());
  Omega_.conservativeResizeLike(Eigen::MatrixXd::Zero(rows, rows));
  r_.conservativeResizeLike(Eigen::VectorXd::Zero(rows));
  for (std::size_t i = 0; i < at.size(); ++i) {
    Eigen::Vector2d r(piece.r[2 * i], piece.r[2 * i + 1]);
    for (std::size_t j = 0; j < at.size(); ++j) {
      const Eigen::Matrix2d block = piece.block(i, j);
      Omega_.block<2, 2>(row_of(at[i]), row_of(at[j])) += block;
      r -= block * (references_[at[j]] - piece.members[j].reference);
    }
    r_.segment<2>(row_of(at[i])) += r;
  }
}

std::optional<TeamPiece> PieceSum::take() {
  TeamPiece piece;
  std::vector<Eigen::Index> told, gone;  // rows
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    std::vector<Eigen::Index>& rows = is_start_point(ids_[i]) ? gone : told;
    rows.insert(rows.end(), {row_of(i), row_of(i) + 1});
    if (is_start_point(ids_[i])) continue;
    piece.landmarks.push_back(ids_[i]);
    piece.references.push_back(references_[i]);
  }
  piece.Omega = Omega_(told, told);
  piece.r = r_(told);
  if (!gone.empty()) {  // marginalised out; the block may be singular
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> of_gone(
        Eigen::MatrixXd(Omega_(gone, gone)));
    const Eigen::MatrixXd G = of_gone.solve(Eigen::MatrixXd(Omega_(gone, told)));
    piece.Omega -= Omega_(told, gone) * G;
    piece.r -= G.transpose() * r_(gone);
  }
  ids_.clear();
  references_.clear();
  Omega_.resize(0, 0);
  r_.resize(0);
  const auto is_apart = [&](const Eigen::Vector2d& p) {
    return (p - piece.references.front()).norm() > least_spread;
  };
  if (std::ranges::none_of(piece.references, is_apart)) return std::nullopt;
  return piece;
}

}  // namespace seif
