#include "seif/tree/front.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "seif/tree/room.hpp"

namespace seif {

void Front::begin() {
  rows_.begin();
  variables_.clear();
  damped_.clear();
  parts_.clear();
  next_part_ = 0;
}

std::size_t Front::index_of(FrontVariable v) {
  const auto next = static_cast<int>(variables_.size());
  const int index = rows_.index_of(v, next);
  if (index == next) variables_.push_back({.variable = v, .balance = 0, .group = v, .lever = Lever::Zero()});
  return static_cast<std::size_t>(index);
}

void Front::add(const Condensed& part, bool is_in_place) {
  if (part.boundary.empty()) return;
  for (const Condensed::Member& m : part.boundary) variables_[index_of(m.variable)].balance += m.balance;
  parts_.push_back({&part, is_in_place});
}

void Front::tie(std::size_t index, FrontVariable group, const Lever& lever) {
  variables_[index_of(group)].balance += variables_[index].balance;
  variables_[index].group = group;
  variables_[index].lever = lever;
}

// The matrix: the columns of E in full, as the factor will stand in the message, and those of B among
// themselves. Parts come in whichever triangle it may be; fold() brings them to the lower one.

void Front::begin_matrix(Condensed& out) {
  out_ = &out;
  e_ = out.e;
  size_ = out.e + out.b;
  next_column_ = 0;
  for (const Variable& v : variables_) {
    if (v.group == v.variable) continue;
    out.tied.push_back(
        {.variable = v.variable, .row = v.group, .lever = v.lever, .reference = GroupMotion::Zero()});
  }
  // Groups have rows only now.
  rows_.give(out);
  for (Condensed::Tie& tie : out.tied) tie.row = rows_.row_of(tie.row);
  rows_.give(out);
  out.factor = pool_.take(static_cast<std::size_t>(size_) * static_cast<std::size_t>(e_));
  std::fill_n(out.factor.data(), out.factor.size(), 0.0);
  of_E_ = out.factor.data();
  const Eigen::Index entries = Eigen::Index{out.b} * out.b;
  make_room(of_B_, entries);
  of_B_.head(entries).setZero();
  make_room(r_, size_);
  r_.head(size_).setZero();
  constexpr double dilation_sd = 0.05;  // [-] far more than a closure stretches
  for (const FrontVariable group : damped_) {
    const int row = rows_.row_of(group) + 3;
    entry(row, row) += 1.0 / (dilation_sd * dilation_sd);
  }
}

/// Of a pair of rows.
double& Front::entry(int i, int j) {
  const auto row = static_cast<std::ptrdiff_t>(std::max(i, j));
  const auto col = static_cast<std::ptrdiff_t>(std::min(i, j));
  return col < e_ ? of_E_[col * size_ + row] : of_B_(col_of_B(col) + row - e_);
}

void Front::assemble_next(const Turning& turning, std::span<const MovedPlace> places) {
  const auto& [part, is_in_place] = parts_[next_part_++];
  rows_.list(*part);
  if (!is_in_place) moved_.bring(turning, places, *part);
  const double* const S = is_in_place ? part->S.data() : moved_.S();
  if (rows_.any_tied()) {
    add_tied(part->b, S);
  } else {
    add_untied(S);
  }
  add_residual(is_in_place ? part->s.data() : moved_.r());
  blocks_touched_ += (is_in_place ? 1 : 2) * part->boundary_blocks();
  if (next_part_ < parts_.size()) return;
  fold(of_E_, size_, e_);
  fold(of_B_.data(), out_->b, out_->b);
}

void Front::add_untied(const double* S) {
  const std::size_t count = rows_.listed();
  for (std::size_t j = 0; j < count; ++j) {
    const std::ptrdiff_t col = rows_.terms(j)[0].row;
    if (col < e_) {
      double* const column = of_E_ + col * size_;
      for (std::size_t i = j; i < count; ++i) column[rows_.terms(i)[0].row] += *S++;
      continue;
    }
    double* const column = of_B_.data() + col_of_B(col);
    for (std::size_t i = j; i < count; ++i) {
      const std::ptrdiff_t row = rows_.terms(i)[0].row;
      (row < e_ ? of_E_[row * size_ + col] : column[row - e_]) += *S++;
    }
  }
}

/// What stands in the upper triangle of a square (n x n) goes to the lower one.
void Front::fold(double* square, Eigen::Index stride, Eigen::Index n) {
  constexpr Eigen::Index tile = 8;
  Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> M(square, n, n, Eigen::OuterStride<>(stride));
  const Eigen::Index whole = n - n % tile;
  for (Eigen::Index col = 0; col < whole; col += tile) {
    for (Eigen::Index row = col + tile; row < whole; row += tile)
      M.block<tile, tile>(row, col) += M.block<tile, tile>(col, row).transpose();
    for (Eigen::Index j = col; j < col + tile; ++j) {
      for (Eigen::Index i = j + 1; i < col + tile; ++i) M(i, j) += M(j, i);
    }
  }
  for (Eigen::Index i = whole; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) M(i, j) += M(j, i);
  }
}

/// P' S P. With S = H + H', H its lower triangle with half the diagonal, that is K + K', K' = (H P)' P: sums
/// of whole columns, twice, as long as the list of rows that the part moves.
void Front::add_tied(Eigen::Index b, const double* S) {
  list_moved_rows();
  const auto n = static_cast<Eigen::Index>(moved_rows_.size());
  make_room(half_, n * std::max(b, n));
  make_room(transposed_, n * b);
  Eigen::Map<Eigen::MatrixXd> HP(half_.data(), b, n);
  HP.setZero();
  for (Eigen::Index j = 0; j < b; ++j) {
    const Eigen::Map<const Eigen::VectorXd> below(S, b - j);
    for (const FrontRows::Term& term : rows_.terms(static_cast<std::size_t>(j))) {
      auto column = HP.col(column_of_row_[static_cast<std::size_t>(term.row)]).tail(b - j);
      column(0) -= 0.5 * term.weight * below(0);
      column += term.weight * below;
    }
    S += b - j;
  }
  Eigen::Map<Eigen::MatrixXd> transposed(transposed_.data(), n, b);
  transposed = HP.transpose();
  Eigen::Map<Eigen::MatrixXd> K(half_.data(), n, n);  // H P is done with
  K.setZero();
  for (Eigen::Index i = 0; i < b; ++i) {
    for (const FrontRows::Term& term : rows_.terms(static_cast<std::size_t>(i)))
      K.col(column_of_row_[static_cast<std::size_t>(term.row)]) += term.weight * transposed.col(i);
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      entry(moved_rows_[static_cast<std::size_t>(i)], moved_rows_[static_cast<std::size_t>(j)]) +=
          i == j ? 2.0 * K(i, i) : K(i, j) + K(j, i);
    }
  }
}

/// The rows of the front that the part's go to, each once, and beside them the index in that list.
void Front::list_moved_rows() {
  moved_rows_.clear();
  column_of_row_.assign(static_cast<std::size_t>(size_), -1);
  for (std::size_t i = 0; i < rows_.listed(); ++i) {
    for (const FrontRows::Term& term : rows_.terms(i)) {
      int& column = column_of_row_[static_cast<std::size_t>(term.row)];
      if (column >= 0) continue;
      column = static_cast<int>(moved_rows_.size());
      moved_rows_.push_back(term.row);
    }
  }
}

void Front::add_residual(const double* r) {
  for (std::size_t i = 0; i < rows_.listed(); ++i) {
    for (const FrontRows::Term& term : rows_.terms(i)) r_(term.row) += term.weight * r[i];
  }
}

/// Cholesky of some columns of E: so few that Eigen's products need no memory of the heap.
bool Front::eliminate_next() {
  constexpr Eigen::Index most_columns = 48;
  const Eigen::Index from = next_column_;
  const Eigen::Index e = e_;
  const Eigen::Index n = size_;
  const Eigen::Index b = n - e;
  const Eigen::Index columns = std::min(most_columns, e - from);
  const Eigen::Index next = from + columns;
  Eigen::Map<Eigen::MatrixXd> left(of_E_, n, e);
  Eigen::Map<Eigen::MatrixXd> rest(of_B_.data(), b, b);
  blocks_touched_ += Condensed::blocks_of(n - from);
  next_column_ = static_cast<int>(next);
  auto block = left.block(from, from, columns, columns);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(block);
  if (llt.info() != Eigen::Success) return false;
  auto y = r_.segment(from, columns);
  llt.matrixL().solveInPlace(y);
  if (next == n) return true;
  auto below = left.block(next, from, n - next, columns);
  llt.matrixL().transpose().solveInPlace<Eigen::OnTheRight>(below);
  r_.segment(next, n - next).noalias() -= below * y;
  if (next < e) {
    left.block(next, next, e - next, e - next)
        .selfadjointView<Eigen::Lower>()
        .rankUpdate(below.topRows(e - next), -1.0);
    left.block(e, next, b, e - next).noalias() -= below.bottomRows(b) * below.topRows(e - next).transpose();
  }
  if (b > 0) rest.selfadjointView<Eigen::Lower>().rankUpdate(below.bottomRows(b), -1.0);
  return true;
}

void Front::finish() {
  Condensed& out = *out_;
  const Eigen::Index b = out.b;
  out.S = pool_.take(static_cast<std::size_t>(b * (b + 1) / 2));
  double* to = out.S.data();
  for (Eigen::Index col = 0; col < b; ++col) to = std::copy_n(&of_B_(col * b + col), b - col, to);
  out.y.assign(r_.begin(), r_.begin() + out.e);
  out.s.assign(r_.begin() + out.e, r_.begin() + size_);
  blocks_touched_ += out.boundary_blocks();
}

std::size_t Front::memory_bytes() const {
  return pool_.memory_bytes() + rows_.memory_bytes() + variables_.capacity() * sizeof(Variable) +
         moved_.memory_bytes() +
         sizeof(double) *
             static_cast<std::size_t>(of_B_.size() + half_.size() + transposed_.size() + r_.size());
}

}  // namespace seif
