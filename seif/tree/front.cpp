#include "seif/tree/front.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace seif {

void Front::begin() {
  ++front_;
  variables_.clear();
  parts_.clear();
  places_.clear();
}

Front::Rows& Front::rows_of(FrontVariable v) {
  ChunkedArray<Rows>& rows = is_group(v) ? groups_ : landmarks_;
  const auto i = static_cast<std::size_t>(is_group(v) ? ~v : v);
  while (rows.size() <= i) rows.push_back({});
  return rows[i];
}

std::size_t Front::index_of(FrontVariable v) {
  Rows& p = rows_of(v);
  if (p.front != front_) {
    p.front = front_;
    p.index = static_cast<int>(variables_.size());
    variables_.push_back({.variable = v, .balance = 0, .group = v, .lever = Eigen::Vector2d::Zero()});
  }
  return static_cast<std::size_t>(p.index);
}

void Front::add(const Condensed& part) {
  if (part.boundary.empty()) return;
  for (const Condensed::Member& m : part.boundary) variables_[index_of(m.variable)].balance += m.balance;
  parts_.push_back({&part, -1});
}

void Front::tie(std::size_t index, FrontVariable group, const Eigen::Vector2d& lever) {
  variables_[index_of(group)].balance += variables_[index].balance;
  variables_[index].group = group;
  variables_[index].lever = lever;
}

// Rows.

void Front::give_rows(const Condensed& front) {
  int row = 0;
  const auto give = [&](FrontVariable v) {
    Rows& p = rows_of(v);
    p.front = front_;
    p.row = row;
    p.tied = false;
    row += freedom(v);
  };
  for (const FrontVariable v : front.eliminated) give(v);
  for (const Condensed::Member& m : front.boundary) give(m.variable);
  for (const Condensed::Tie& tie : front.tied) {
    Rows& p = rows_of(tie.variable);
    p.front = front_;
    p.row = tie.row;
    p.tied = true;
    p.lever = tie.lever;
  }
  size_ = row;
}

void Front::add_targets(FrontVariable v) {
  const Rows& p = rows_of(v);
  constexpr int none = -1;
  const int turn = p.tied ? p.row + 2 : none;
  targets_.push_back({p.row, turn, -p.lever.y()});
  targets_.push_back({p.row + 1, turn, p.lever.x()});
  if (is_group(v)) targets_.push_back({p.row + 2, none, 0.0});
  any_tied_ = any_tied_ || p.tied;
}

void Front::find_targets(const Condensed& part) {
  targets_.clear();
  any_tied_ = false;
  for (const Condensed::Member& m : part.boundary) add_targets(m.variable);
}

// The matrix: the columns of E in full, as the factor will stand in the message, and those of B among
// themselves. Parts come in whichever triangle it may be; fold() brings them to the lower one.

void Front::clear_matrix(Condensed& out) {
  e_ = out.e;
  size_ = out.e + out.b;
  out.factor = pool_->take(static_cast<std::size_t>(size_) * static_cast<std::size_t>(e_));
  std::fill_n(out.factor.data(), out.factor.size(), 0.0);
  of_E_ = out.factor.data();
  const Eigen::Index entries = Eigen::Index{out.b} * out.b;
  if (of_B_.size() < entries) of_B_.resize(2 * entries);
  of_B_.head(entries).setZero();
}

/// Of a pair of rows.
double& Front::entry(int i, int j) {
  const auto row = static_cast<std::ptrdiff_t>(std::max(i, j));
  const auto col = static_cast<std::ptrdiff_t>(std::min(i, j));
  return col < e_ ? of_E_[col * size_ + row] : of_B_(col_of_B(col) + row - e_);
}

/// Of P' A P, what one entry of A and its mirror image add.
void Front::add_product(const Target& i, const Target& j, double value, bool diagonal) {
  const auto add = [&](int row_i, int row_j, double term) {
    entry(row_i, row_j) += row_i == row_j && !diagonal ? 2.0 * term : term;
  };
  add(i.row, j.row, value);
  if (i.second >= 0) add(i.second, j.row, i.weight * value);
  if (j.second >= 0 && !diagonal) add(i.row, j.second, j.weight * value);
  if (i.second >= 0 && j.second >= 0) add(i.second, j.second, i.weight * j.weight * value);
}

void Front::assemble(Condensed& out) {
  give_rows(out);
  clear_matrix(out);
  for (const Part& part : parts_) {
    find_targets(*part.condensed);
    const double* const S = in_its_place(part);
    if (any_tied_) {
      add_tied(*part.condensed, S);
    } else {
      add_untied(S);
    }
  }
  fold(of_E_, size_, e_);
  fold(of_B_.data(), out.b, out.b);
}

/// The lower triangle of S, brought to where its variables are.
const double* Front::in_its_place(const Part& p) {
  const Condensed& part = *p.condensed;
  if (p.first_place < 0) return part.S.data();
  const Eigen::Index b = part.b;
  if (square_.size() < b * b) square_.resize(2 * b * b);
  if (turned_.size() < b * (b + 1) / 2) turned_.resize(b * (b + 1));
  Eigen::Map<Eigen::MatrixXd> S(square_.data(), b, b);
  part.unpack(S);
  moved_.fit(near_,
             std::span(places_).subspan(static_cast<std::size_t>(p.first_place), part.boundary.size()));
  moved_.bring(S);
  double* to = turned_.data();
  for (Eigen::Index col = 0; col < b; ++col) to = std::copy_n(&S(col, col), b - col, to);
  return turned_.data();
}

void Front::add_untied(const double* S) {
  for (std::size_t j = 0; j < targets_.size(); ++j) {
    const std::ptrdiff_t col = targets_[j].row;
    if (col < e_) {
      double* const column = of_E_ + col * size_;
      for (std::size_t i = j; i < targets_.size(); ++i) column[targets_[i].row] += *S++;
      continue;
    }
    double* const column = of_B_.data() + col_of_B(col);
    for (std::size_t i = j; i < targets_.size(); ++i) {
      const std::ptrdiff_t row = targets_[i].row;
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
void Front::add_tied(const Condensed& part, const double* S) {
  list_moved_rows();
  const auto n = static_cast<Eigen::Index>(moved_rows_.size());
  const Eigen::Index room = n * std::max<Eigen::Index>(part.b, n);
  if (half_.size() < room) {
    half_.resize(2 * room);
    transposed_.resize(2 * room);
  }
  Eigen::Map<Eigen::MatrixXd> HP(half_.data(), part.b, n);
  HP.setZero();
  for (Eigen::Index j = 0; j < part.b; ++j) {
    const Eigen::Map<const Eigen::VectorXd> below(S, part.b - j);
    const auto add_column = [&](int row, double weight) {
      auto column = HP.col(column_of_row_[static_cast<std::size_t>(row)]).tail(part.b - j);
      column(0) -= 0.5 * weight * below(0);
      column += weight * below;
    };
    const Target& target = targets_[static_cast<std::size_t>(j)];
    add_column(target.row, 1.0);
    if (target.second >= 0) add_column(target.second, target.weight);
    S += part.b - j;
  }
  Eigen::Map<Eigen::MatrixXd> transposed(transposed_.data(), n, part.b);
  transposed = HP.transpose();
  Eigen::Map<Eigen::MatrixXd> K(half_.data(), n, n);  // H P is done with
  K.setZero();
  for (Eigen::Index i = 0; i < part.b; ++i) {
    const auto add_column = [&](int row, double weight) {
      K.col(column_of_row_[static_cast<std::size_t>(row)]) += weight * transposed.col(i);
    };
    const Target& target = targets_[static_cast<std::size_t>(i)];
    add_column(target.row, 1.0);
    if (target.second >= 0) add_column(target.second, target.weight);
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
  const auto list = [&](int row) {
    int& column = column_of_row_[static_cast<std::size_t>(row)];
    if (column >= 0) return;
    column = static_cast<int>(moved_rows_.size());
    moved_rows_.push_back(row);
  };
  for (const Target& target : targets_) {
    list(target.row);
    if (target.second >= 0) list(target.second);
  }
}

void Front::add_to_rows(const Target& target, double value) {
  r_(target.row) += value;
  if (target.second >= 0) r_(target.second) += target.weight * value;
}

/// Cholesky of the columns of E, some at a time: so few that Eigen's products need no memory of the heap.
bool Front::eliminate(Eigen::Index b) {
  constexpr Eigen::Index most_columns = 48;
  const Eigen::Index e = e_;
  const Eigen::Index n = e + b;
  Eigen::Map<Eigen::MatrixXd> left(of_E_, n, e);
  Eigen::Map<Eigen::MatrixXd> rest(of_B_.data(), b, b);
  for (Eigen::Index from = 0; from < e; from += most_columns) {
    const Eigen::Index columns = std::min(most_columns, e - from);
    const Eigen::Index next = from + columns;
    auto block = left.block(from, from, columns, columns);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(block);
    if (llt.info() != Eigen::Success) return false;
    if (next == n) continue;
    auto below = left.block(next, from, n - next, columns);
    llt.matrixL().transpose().solveInPlace<Eigen::OnTheRight>(below);
    if (next < e) {
      left.block(next, next, e - next, e - next)
          .selfadjointView<Eigen::Lower>()
          .rankUpdate(below.topRows(e - next), -1.0);
      left.block(e, next, b, e - next).noalias() -= below.bottomRows(b) * below.topRows(e - next).transpose();
    }
    if (b > 0) rest.selfadjointView<Eigen::Lower>().rankUpdate(below.bottomRows(b), -1.0);
  }
  return true;
}

bool Front::factorise(Condensed& out) {
  give_rows(out);
  for (const Variable& v : variables_) {
    if (v.group != v.variable) {
      out.tied.push_back({.variable = v.variable,
                          .row = rows_of(v.group).row,
                          .lever = v.lever,
                          .reference = Eigen::Vector3d::Zero()});
    }
  }
  assemble(out);
  const Eigen::Index b = out.b;
  if (!eliminate(b)) return false;
  out.S = pool_->take(static_cast<std::size_t>(b * (b + 1) / 2));
  double* to = out.S.data();
  for (Eigen::Index col = 0; col < b; ++col) to = std::copy_n(&of_B_(col * b + col), b - col, to);
  return true;
}

// The residual.

void Front::begin_residual(const Condensed& front) {
  ++front_;
  give_rows(front);
  if (r_.size() < size_) r_.resize(2 * size_);
  r_.head(size_).setZero();
}

void Front::add_residual(const Condensed& part, const Eigen::Ref<const Eigen::VectorXd>& r) {
  find_targets(part);
  for (Eigen::Index i = 0; i < part.b; ++i) add_to_rows(targets_[static_cast<std::size_t>(i)], r(i));
}

void Front::add_residual(int slot, const Eigen::Vector2d& r) {
  targets_.clear();
  add_targets(slot);
  add_to_rows(targets_[0], r.x());
  add_to_rows(targets_[1], r.y());
}

void Front::condense_residual(Condensed& front) {
  auto y = r_.head(front.e);
  auto s = r_.segment(front.e, front.b);
  const auto columns = front.L_and_G();
  columns.topRows(front.e).triangularView<Eigen::Lower>().solveInPlace(y);
  s.noalias() -= columns.bottomRows(front.b) * y;
  front.y.assign(y.begin(), y.end());
  front.s.assign(s.begin(), s.end());
}

std::size_t Front::memory_bytes() const {
  return pool_->memory_bytes() + landmarks_.memory_bytes() + groups_.memory_bytes() +
         variables_.capacity() * sizeof(Variable) +
         static_cast<std::size_t>(of_B_.size() + half_.size() + transposed_.size() + square_.size() +
                                  turned_.size()) *
             sizeof(double);
}

}  // namespace seif
