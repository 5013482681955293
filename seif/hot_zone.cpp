#include "seif/hot_zone.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace seif {

void HotZone::reserve(int landmarks) {
  const Eigen::Index rows = 2 * landmarks;
  if (rows <= F_.rows()) return;
  const Eigen::Index room = std::max<Eigen::Index>(rows, 2 * F_.rows());
  F_.conservativeResizeLike(Eigen::MatrixXd::Zero(room, room));
  mean_.conservativeResize(room);
  columns_.resize(room, room);
  swept_.resize(room, room);
  pivot_.resize(room, room);
  members_.reserve(static_cast<std::size_t>(room / 2));
}

void HotZone::load(const Condensed& without) {
  members_.clear();
  reserve(static_cast<int>(without.boundary.size()));
  for (const Condensed::Member& m : without.boundary)
    members_.push_back({.slot = m.variable, .active = true});
  const auto n = 2 * static_cast<Eigen::Index>(size());
  const double* S = without.S.data();
  for (Eigen::Index col = 0; col < n; ++col) {
    F_.col(col).segment(col, n - col) = Eigen::Map<const Eigen::VectorXd>(S, n - col);
    F_.row(col).segment(col, n - col) = F_.col(col).segment(col, n - col);
    S += n - col;
  }
  mean_.head(n).setZero();
  blocks_touched_ += without.blocks();
}

int HotZone::add(int slot, const Eigen::Vector2d& mean) {
  const int place = size();
  reserve(place + 1);
  members_.push_back({.slot = slot, .active = true});
  F_.middleCols<2>(2 * place).topRows(2 * place + 2).setZero();
  F_.middleRows<2>(2 * place).leftCols(2 * place + 2).setZero();
  set_mean(place, mean);
  return place;
}

void HotZone::add_information(int a, int b, const Eigen::Matrix2d& Omega_ab) {
  block(a, b) += Omega_ab;
  if (a != b) block(b, a) += Omega_ab.transpose();
  ++blocks_touched_;
}

/// Of A = sign F_TT with T the places, U = F_:T and V = U A^-1:
///   F -= sign V U',   F_:T = V,   F_TT = -sign A^-1.
bool HotZone::sweep(std::span<const int> places, double sign) {
  const auto n = 2 * static_cast<Eigen::Index>(size());
  const auto t = 2 * static_cast<Eigen::Index>(places.size());
  auto U = columns_.topLeftCorner(n, t);
  auto V = swept_.topLeftCorner(n, t);
  auto A = pivot_.topLeftCorner(t, t);
  Eigen::Index col = 0;
  for (const int place : places) {
    U.middleCols<2>(col) = F_.middleCols<2>(2 * place).topRows(n);
    for (std::size_t i = 0; i < places.size(); ++i) {
      A.block<2, 2>(2 * static_cast<Eigen::Index>(i), col) = sign * block(places[i], place);
    }
    col += 2;
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(A);
  if (llt.info() != Eigen::Success) return false;
  V = U;
  llt.matrixL().transpose().solveInPlace<Eigen::OnTheRight>(V);
  llt.matrixL().solveInPlace<Eigen::OnTheRight>(V);
  auto F = F_.topLeftCorner(n, n);
  F.triangularView<Eigen::Lower>() -= (sign * V) * U.transpose();
  F.triangularView<Eigen::StrictlyUpper>() = F.transpose();
  col = 0;
  for (const int place : places) {
    F.middleCols<2>(2 * place) = V.middleCols<2>(col);
    F.middleRows<2>(2 * place) = V.middleCols<2>(col).transpose();
    col += 2;
  }
  auto inverse = swept_.topLeftCorner(t, t);  // V is done with
  inverse.setIdentity();
  llt.solveInPlace(inverse);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) {
      block(places[i], places[j]) =
          -sign * inverse.block<2, 2>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(j));
    }
    members_[static_cast<std::size_t>(places[i])].active = sign < 0.0;
  }
  blocks_touched_ += std::int64_t{size()} * (size() + 1) / 2;
  return true;
}

/// -W' d_A of one place in P.
Eigen::Vector2d HotZone::step_of(int place, const Eigen::VectorXd& d) const {
  Eigen::Vector2d d_P = Eigen::Vector2d::Zero();
  for (int a = 0; a < size(); ++a) {
    if (is_active(a)) d_P -= block(place, a) * d.segment<2>(2 * a);
  }
  return d_P;
}

std::size_t HotZone::memory_bytes() const {
  return sizeof(double) * static_cast<std::size_t>(F_.size() + mean_.size() + columns_.size() +
                                                   swept_.size() + pivot_.size()) +
         members_.capacity() * sizeof(Member);
}

}  // namespace seif
