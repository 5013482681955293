#include "seif/front.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace seif {

void Condensed::clear() {
  boundary.clear();
  eliminated.clear();
  factor.clear();
  S.clear();
  reference.clear();
}

std::size_t Condensed::memory_bytes() const {
  return boundary.capacity() * sizeof(Mention) + eliminated.capacity() * sizeof(int) +
         (factor.capacity() + S.capacity() + reference.capacity()) * sizeof(double);
}

void Front::begin() {
  ++front_;
  entries_.clear();
  blocks_.clear();
  parts_.clear();
}

std::size_t Front::entry_of(int slot) {
  Place& place = places_[static_cast<std::size_t>(slot)];
  if (place.front != front_) {
    place.front = front_;
    place.entry = static_cast<int>(entries_.size());
    entries_.push_back({.slot = slot, .leaves = 0, .row = 0});
  }
  return static_cast<std::size_t>(place.entry);
}

void Front::add(const Condensed& part) {
  if (part.boundary.empty()) return;
  for (const Condensed::Mention& m : part.boundary) entries_[entry_of(m.slot)].leaves += m.leaves;
  parts_.push_back(&part);
}

void Front::add(int slot_i, int slot_j, const Eigen::Matrix2d& Omega_ij) {
  blocks_.push_back({.entry_i = entry_of(slot_i), .entry_j = entry_of(slot_j), .Omega_ij = Omega_ij});
}

int Front::row_of(int slot) const {
  return entries_[static_cast<std::size_t>(places_[static_cast<std::size_t>(slot)].entry)].row;
}

void Front::assemble(const Condensed& out, Eigen::Index size) {
  int row = 0;
  const auto give_row = [&](int slot) {
    entries_[entry_of(slot)].row = row;
    row += 2;
  };
  for (const int slot : out.eliminated) give_row(slot);
  for (const Condensed::Mention& m : out.boundary) give_row(m.slot);

  if (M_.rows() < size) M_.resize(2 * size, 2 * size);
  for (Eigen::Index col = 0; col < size; ++col) M_.col(col).segment(col, size - col).setZero();
  for (const Block& block : blocks_) {
    const int i = entries_[block.entry_i].row;
    const int j = entries_[block.entry_j].row;
    if (i >= j) {
      M_.block<2, 2>(i, j) += block.Omega_ij;
    } else {
      M_.block<2, 2>(j, i) += block.Omega_ij.transpose();
    }
  }
  for (const Condensed* part : parts_) {
    rows_.clear();
    for (const Condensed::Mention& m : part->boundary) {
      rows_.push_back(row_of(m.slot));
      rows_.push_back(rows_.back() + 1);
    }
    const double* S = part->S.data();
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      for (std::size_t i = j; i < rows_.size(); ++i) {
        M_(std::max(rows_[i], rows_[j]), std::min(rows_[i], rows_[j])) += *S++;
      }
    }
  }
}

bool Front::factorise(Condensed& out) {
  const auto e = 2 * static_cast<Eigen::Index>(out.eliminated.size());
  const auto b = 2 * static_cast<Eigen::Index>(out.boundary.size());
  const auto n = e + b;
  assemble(out, n);
  auto M_EE = M_.topLeftCorner(e, e);
  auto M_BE = M_.block(e, 0, b, e);
  auto M_BB = M_.block(e, e, b, b);
  if (e > 0) {
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(M_EE);
    if (llt.info() != Eigen::Success) return false;
    if (b > 0) {
      llt.matrixL().transpose().solveInPlace<Eigen::OnTheRight>(M_BE);
      M_BB.selfadjointView<Eigen::Lower>().rankUpdate(M_BE, -1.0);
    }
  }
  out.factor.resize(static_cast<std::size_t>(n * e));
  Eigen::Map<Eigen::MatrixXd>(out.factor.data(), n, e) = M_.topLeftCorner(n, e);
  out.S.resize(static_cast<std::size_t>(b * (b + 1) / 2));
  double* S = out.S.data();
  for (Eigen::Index col = 0; col < b; ++col) {
    S = std::copy_n(&M_BB(col, col), b - col, S);
  }
  return true;
}

std::size_t Front::memory_bytes() const {
  return places_.memory_bytes() + entries_.capacity() * sizeof(Entry) + blocks_.capacity() * sizeof(Block) +
         static_cast<std::size_t>(M_.size()) * sizeof(double);
}

}  // namespace seif
