#include "seif/team/tree_news.hpp"

#include <Eigen/Geometry>

#include "seif/packed_triangle.hpp"
#include "seif/relocating/rigid_fit.hpp"

namespace seif {

namespace {

constexpr int least_known = 3;        // [-] landmarks of a piece
constexpr double least_share = 0.25;  // of the piece's extent: theirs

using Box = Eigen::AlignedBox2d;

}  // namespace

bool TreeNews::has_place_for(const TeamPiece& piece) const {
  Box all, known;
  int count = 0;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    all.extend(piece.references[i]);
    const auto slot = state_.find(piece.landmarks[i]);
    if (!slot || *slot >= settled_) continue;
    known.extend(piece.references[i]);
    ++count;
  }
  return count >= least_known && known.diagonal().norm() >= least_share * all.diagonal().norm();
}

void TreeNews::add(const TeamPiece& piece) {
  told_.clear();
  known_.clear();
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const auto slot = state_.find(piece.landmarks[i]);
    if (!slot || *slot >= settled_) continue;
    told_.push_back(piece.references[i]);
    known_.push_back(tree_.mean(state_, *slot));
    offset += tree_.home(*slot) - known_.back();
  }
  home_offset_ = offset / static_cast<double>(known_.size());
  const TeamPiece here = moved(rigid_fit(told_, known_).value(), piece);
  frozen_.slots.clear();
  frozen_.members.clear();
  for (std::size_t i = 0; i < here.size(); ++i)
    frozen_.members.push_back({join(here, i), here.references[i]});
  frozen_.r.assign(here.r.begin(), here.r.end());
  frozen_.Omega.resize(static_cast<std::size_t>(packed_size(here.Omega.rows())));
  pack_triangle(here.Omega, frozen_.Omega.data());
  tree_.add_anywhere(state_, frozen_);
}

/// The slot of a landmark of the piece, which joins the map if it is new.
int TreeNews::join(const TeamPiece& piece, std::size_t i) {
  if (const auto slot = state_.find(piece.landmarks[i])) return *slot;
  constexpr bool is_settled = true;  // by its teller
  const int slot = state_.add_landmark(piece.landmarks[i], piece.references[i], is_settled);
  tree_.join_anywhere(state_, slot, piece.references[i] + home_offset_);
  return slot;
}

}  // namespace seif
