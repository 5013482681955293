#include "seif/tree/hot_zone.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "seif/tree/room.hpp"

namespace seif {

void HotZone::reserve(int landmarks) {
  const Eigen::Index rows = 2 * landmarks;
  if (rows <= F_.rows()) return;
  const Eigen::Index room = rows + rows / 4;
  F_.conservativeResizeLike(Eigen::MatrixXd::Zero(room, room));
  mean_.conservativeResize(room);
  s_.conservativeResize(room);
  step_.resize(room);
  members_.reserve(static_cast<std::size_t>(room / 2));
  rest_.reserve(static_cast<std::size_t>(room / 2));
}

void HotZone::load(const Condensed& all) {
  members_.clear();
  reserve(static_cast<int>(all.boundary.size()));
  for (const Condensed::Member& m : all.boundary) members_.push_back({.slot = m.variable, .active = true});
  const auto n = 2 * static_cast<Eigen::Index>(size());
  const double* S = all.S.data();
  for (Eigen::Index col = 0; col < n; ++col) {
    F_.col(col).segment(col, n - col) = Eigen::Map<const Eigen::VectorXd>(S, n - col);
    F_.row(col).segment(col, n - col) = F_.col(col).segment(col, n - col);
    S += n - col;
  }
  mean_.head(n).setZero();
  s_.head(n) = Eigen::Map<const Eigen::VectorXd>(all.s.data(), n);
  blocks_touched_ += all.boundary_blocks();
}

void HotZone::bring(MovedBoundary& moved, std::span<const MovedPlace> places) {
  const Eigen::Index n = 2 * size();
  auto F = F_.topLeftCorner(n, n);
  auto d = step_.head(n);
  moved.steps(places, d);
  s_.head(n).noalias() -= F * d;
  moved.bring(F);
  moved.bring_residual(s_.head(n));
  blocks_touched_ += all_blocks();
}

int HotZone::add(int slot, const Eigen::Vector2d& mean) {
  const int index = size();
  reserve(index + 1);
  members_.push_back({.slot = slot, .active = true});
  F_.middleCols<2>(2 * index).topRows(2 * index + 2).setZero();
  F_.middleRows<2>(2 * index).leftCols(2 * index + 2).setZero();
  set_mean(index, mean);
  s_.segment<2>(2 * index).setZero();
  return index;
}

void HotZone::add_information(int a, int b, const Eigen::Matrix2d& Omega_ab) {
  block(a, b) += Omega_ab;
  if (a != b) block(b, a) += Omega_ab.transpose();
  ++blocks_touched_;
}

void HotZone::list_rest(std::span<const int> indices) {
  rest_.clear();
  for (int index = 0; index < size(); ++index) {
    if (std::ranges::find(indices, index) == indices.end()) rest_.push_back(index);
  }
}

/// F_RR -= sign change, of which the lower triangle is known.
void HotZone::spread_change(double sign, Eigen::Ref<Eigen::MatrixXd> change) {
  const auto at = [](std::size_t i) { return 2 * static_cast<Eigen::Index>(i); };
  for (std::size_t j = 0; j < rest_.size(); ++j) {
    change(at(j), at(j) + 1) = change(at(j) + 1, at(j));
    for (std::size_t i = j; i < rest_.size(); ++i) {
      const Eigen::Matrix2d step = sign * change.block<2, 2>(at(i), at(j));
      block(rest_[i], rest_[j]) -= step;
      if (i != j) block(rest_[j], rest_[i]) -= step.transpose();
    }
  }
}

/// With T the indices and R the rest, A = sign F_TT, U = F_RT and V = U A^-1:
///   F_RR -= sign V U',   F_RT = V,   F_TT = -sign A^-1.
bool HotZone::sweep(std::span<const int> indices, double sign) {
  list_rest(indices);
  const auto r = 2 * static_cast<Eigen::Index>(rest_.size());
  const auto t = 2 * static_cast<Eigen::Index>(indices.size());
  make_room(columns_, r * t);
  make_room(swept_, r * t);
  make_room(pivot_, t * t);
  make_room(change_, std::max(r * r, t * t));
  Eigen::Map<Eigen::MatrixXd> U(columns_.data(), r, t);
  Eigen::Map<Eigen::MatrixXd> V(swept_.data(), r, t);
  Eigen::Map<Eigen::MatrixXd> A(pivot_.data(), t, t);
  const auto at = [](std::size_t i) { return 2 * static_cast<Eigen::Index>(i); };
  for (std::size_t j = 0; j < indices.size(); ++j) {
    for (std::size_t i = 0; i < rest_.size(); ++i) U.block<2, 2>(at(i), at(j)) = block(rest_[i], indices[j]);
    for (std::size_t i = 0; i < indices.size(); ++i)
      A.block<2, 2>(at(i), at(j)) = sign * block(indices[i], indices[j]);
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(A);
  if (llt.info() != Eigen::Success) return false;
  V = U;
  llt.matrixL().transpose().solveInPlace<Eigen::OnTheRight>(V);
  llt.matrixL().solveInPlace<Eigen::OnTheRight>(V);
  Eigen::Map<Eigen::MatrixXd> change(change_.data(), r, r);
  change.triangularView<Eigen::Lower>() = V * U.transpose();
  spread_change(sign, change);
  Eigen::Map<Eigen::MatrixXd> inverse(change_.data(), t, t);  // the change is done with
  inverse.setIdentity();
  llt.solveInPlace(inverse);
  for (std::size_t j = 0; j < indices.size(); ++j) {
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      block(rest_[i], indices[j]) = V.block<2, 2>(at(i), at(j));
      block(indices[j], rest_[i]) = V.block<2, 2>(at(i), at(j)).transpose();
    }
    for (std::size_t i = 0; i < indices.size(); ++i)
      block(indices[i], indices[j]) = -sign * inverse.block<2, 2>(at(i), at(j));
    members_[static_cast<std::size_t>(indices[j])].active = sign < 0.0;
  }
  blocks_touched_ += all_blocks();
  return true;
}

bool HotZone::eliminate(std::span<const int> indices) {
  if (!sweep(indices, 1.0)) return false;
  for (int index = 0; index < size(); ++index) {
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();
    for (const int p : indices) pull -= block(index, p) * s_.segment<2>(2 * p);
    if (is_active(index)) {
      s_.segment<2>(2 * index) += pull;
    } else {
      mean_.segment<2>(2 * index) += pull;
    }
  }
  for (const int p : indices) s_.segment<2>(2 * p).setZero();
  return true;
}

void HotZone::set_means(const Eigen::VectorXd& means) {
  const Eigen::Index n = 2 * size();
  for (int a = 0; a < size(); ++a) {
    if (!is_active(a)) continue;
    for (int b = 0; b < size(); ++b) {
      if (is_active(b)) s_.segment<2>(2 * a) -= block(a, b) * (means.segment<2>(2 * b) - mean(b));
    }
  }
  mean_.head(n) = means.head(n);
}

/// -W' d_A of one index in P.
Eigen::Vector2d HotZone::step_of(int index, const Eigen::VectorXd& d) const {
  Eigen::Vector2d d_P = Eigen::Vector2d::Zero();
  for (int a = 0; a < size(); ++a) {
    if (is_active(a)) d_P -= block(index, a) * d.segment<2>(2 * a);
  }
  return d_P;
}

std::size_t HotZone::memory_bytes() const {
  return sizeof(double) * static_cast<std::size_t>(F_.size() + mean_.size() + s_.size() + columns_.size() +
                                                   swept_.size() + pivot_.size() + change_.size()) +
         members_.capacity() * sizeof(Member);
}

}  // namespace seif
