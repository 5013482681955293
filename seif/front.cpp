#include "seif/front.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace seif {

void Condensed::clear() {
  eliminated.clear();
  boundary.clear();
  tied.clear();
  e = b = 0;
  factor.clear();
  S.clear();
  y.clear();
  s.clear();
  reference.clear();
}

void Condensed::take(Condensed& other) {
  eliminated = other.eliminated;
  boundary = other.boundary;
  tied = other.tied;
  e = other.e;
  b = other.b;
  factor = std::move(other.factor);
  S = std::move(other.S);
  y = other.y;
  s = other.s;
  reference = other.reference;
}

void Condensed::residual(const Eigen::Ref<const Eigen::VectorXd>& d, Eigen::Ref<Eigen::VectorXd> r) const {
  r = Eigen::Map<const Eigen::VectorXd>(s.data(), b);
  const double* column = S.data();
  for (Eigen::Index j = 0; j < b; ++j) {
    const Eigen::Map<const Eigen::VectorXd> S_j(column, b - j);
    r(j) -= S_j.dot(d.tail(b - j));
    r.tail(b - j - 1) -= d(j) * S_j.tail(b - j - 1);
    column += b - j;
  }
}

std::size_t Condensed::memory_bytes() const {
  return boundary.capacity() * sizeof(Member) + eliminated.capacity() * sizeof(FrontVariable) +
         tied.capacity() * sizeof(Tie) +
         (y.capacity() + s.capacity() + reference.capacity()) * sizeof(double);
}

void Front::begin() {
  ++front_;
  variables_.clear();
  blocks_.clear();
  parts_.clear();
}

Front::Place& Front::place(FrontVariable v) {
  ChunkedArray<Place>& places = is_group(v) ? groups_ : landmarks_;
  const auto i = static_cast<std::size_t>(is_group(v) ? ~v : v);
  while (places.size() <= i) places.push_back({});
  return places[i];
}

std::size_t Front::index_of(FrontVariable v) {
  Place& p = place(v);
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
  parts_.push_back(&part);
}

void Front::add(int slot_i, int slot_j, const Eigen::Matrix2d& Omega_ij) {
  blocks_.push_back({.i = slot_i, .j = slot_j, .Omega_ij = Omega_ij});
}

void Front::tie(std::size_t index, FrontVariable group, const Eigen::Vector2d& lever) {
  variables_[index_of(group)].balance += variables_[index].balance;
  variables_[index].group = group;
  variables_[index].lever = lever;
}

void Front::list(Condensed& out) const {
  out.clear();
  for (const Variable& v : variables_) {
    out.boundary.push_back({v.variable, v.balance});
    out.b += freedom(v.variable);
  }
}

// Rows.

void Front::give_rows(const Condensed& front) {
  int row = 0;
  const auto give = [&](FrontVariable v) {
    Place& p = place(v);
    p.front = front_;
    p.row = row;
    p.tied = false;
    row += freedom(v);
  };
  for (const FrontVariable v : front.eliminated) give(v);
  for (const Condensed::Member& m : front.boundary) give(m.variable);
  for (const Condensed::Tie& tie : front.tied) {
    Place& p = place(tie.variable);
    p.front = front_;
    p.row = tie.row;
    p.tied = true;
    p.lever = tie.lever;
  }
  size_ = row;
}

void Front::add_targets(FrontVariable v) {
  const Place& p = place(v);
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

// The matrix.

void Front::add_entry(int i, int j, double value) { M_(std::max(i, j), std::min(i, j)) += value; }

/// Of P' A P, what one entry of A and its mirror image add to the lower triangle.
void Front::add_product(const Target& i, const Target& j, double value, bool diagonal) {
  const auto add = [&](int row_i, int row_j, double term) {
    add_entry(row_i, row_j, row_i == row_j && !diagonal ? 2.0 * term : term);
  };
  add(i.row, j.row, value);
  if (i.second >= 0) add(i.second, j.row, i.weight * value);
  if (j.second >= 0 && !diagonal) add(i.row, j.second, j.weight * value);
  if (i.second >= 0 && j.second >= 0) add(i.second, j.second, i.weight * j.weight * value);
}

void Front::assemble(const Condensed& out) {
  give_rows(out);
  if (M_.rows() < size_) M_.resize(2 * size_, 2 * size_);
  for (Eigen::Index col = 0; col < size_; ++col) M_.col(col).segment(col, size_ - col).setZero();
  for (const Block& block : blocks_) {
    targets_.clear();
    add_targets(block.i);
    add_targets(block.j);
    const bool diagonal = block.i == block.j;
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < (diagonal ? a + 1 : 2); ++b) {
        add_product(targets_[static_cast<std::size_t>(a)], targets_[static_cast<std::size_t>(2 + b)],
                    block.Omega_ij(a, b), diagonal && a == b);
      }
    }
  }
  for (const Condensed* part : parts_) {
    find_targets(*part);
    if (any_tied_) {
      add_tied(*part);
      continue;
    }
    const double* S = part->S.data();
    for (std::size_t j = 0; j < targets_.size(); ++j) {
      for (std::size_t i = j; i < targets_.size(); ++i) add_entry(targets_[i].row, targets_[j].row, *S++);
    }
  }
}

/// P' S P, column by column of S. Adds to the upper triangle too, which nobody reads.
void Front::add_tied(const Condensed& part) {
  if (part_.rows() < part.b) part_.resize(2 * part.b, 2 * part.b);
  if (r_.size() < size_) r_.resize(2 * size_);
  const double* S = part.S.data();
  for (Eigen::Index col = 0; col < part.b; ++col) {
    const Eigen::Map<const Eigen::VectorXd> below(S, part.b - col);
    part_.col(col).segment(col, part.b - col) = below;
    part_.row(col).segment(col, part.b - col) = below;
    S += part.b - col;
  }
  auto column = r_.head(size_);
  for (Eigen::Index j = 0; j < part.b; ++j) {
    column.setZero();
    for (Eigen::Index i = 0; i < part.b; ++i) add_to_rows(targets_[static_cast<std::size_t>(i)], part_(i, j));
    const Target& target = targets_[static_cast<std::size_t>(j)];
    M_.col(target.row).head(size_) += column;
    if (target.second >= 0) M_.col(target.second).head(size_) += target.weight * column;
  }
}

void Front::add_to_rows(const Target& target, double value) {
  r_(target.row) += value;
  if (target.second >= 0) r_(target.second) += target.weight * value;
}

/// Cholesky of the first e of n columns, some at a time: so few that Eigen's products need no memory of the
/// heap.
bool Front::eliminate(Eigen::Index e, Eigen::Index n) {
  constexpr Eigen::Index most_columns = 48;
  for (Eigen::Index from = 0; from < e; from += most_columns) {
    const Eigen::Index columns = std::min(most_columns, e - from);
    const Eigen::Index next = from + columns;
    auto block = M_.block(from, from, columns, columns);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(block);
    if (llt.info() != Eigen::Success) return false;
    if (next == n) continue;
    auto below = M_.block(next, from, n - next, columns);
    llt.matrixL().transpose().solveInPlace<Eigen::OnTheRight>(below);
    M_.block(next, next, n - next, n - next).selfadjointView<Eigen::Lower>().rankUpdate(below, -1.0);
  }
  return true;
}

bool Front::factorise(Condensed& out) {
  give_rows(out);
  for (const Variable& v : variables_) {
    if (v.group != v.variable) {
      out.tied.push_back({.variable = v.variable,
                          .row = place(v.group).row,
                          .lever = v.lever,
                          .reference = Eigen::Vector3d::Zero()});
    }
  }
  assemble(out);
  const Eigen::Index e = out.e;
  const Eigen::Index b = out.b;
  const Eigen::Index n = e + b;
  if (!eliminate(e, n)) return false;
  out.factor = pool_->take(static_cast<std::size_t>(n * e));
  double* to = out.factor.data();
  for (Eigen::Index col = 0; col < e; ++col) to = std::copy_n(&M_(0, col), n, to);
  out.S = pool_->take(static_cast<std::size_t>(b * (b + 1) / 2));
  to = out.S.data();
  for (Eigen::Index col = 0; col < b; ++col) to = std::copy_n(&M_(e + col, e + col), b - col, to);
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
         variables_.capacity() * sizeof(Variable) + blocks_.capacity() * sizeof(Block) +
         static_cast<std::size_t>(M_.size()) * sizeof(double);
}

}  // namespace seif
