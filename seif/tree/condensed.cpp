#include "seif/tree/condensed.hpp"

#include <utility>

#include "seif/packed_triangle.hpp"

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

void Condensed::add_to_S(Eigen::Index row, Eigen::Index col, const Eigen::Matrix2d& block) {
  for (Eigen::Index j = 0; j < 2; ++j) {
    double* const column = S.data() + packed_index(b, 0, col + j);
    for (Eigen::Index i = row == col ? j : 0; i < 2; ++i) column[row + i] += block(i, j);
  }
}

void Condensed::unpack(Eigen::Ref<Eigen::MatrixXd> full) const { unpack_triangle(S.data(), full); }

void Condensed::pack(const Eigen::Ref<const Eigen::MatrixXd>& full) { pack_triangle(full, S.data()); }

std::size_t Condensed::memory_bytes() const {
  return boundary.capacity() * sizeof(Member) + eliminated.capacity() * sizeof(FrontVariable) +
         tied.capacity() * sizeof(Tie) +
         (y.capacity() + s.capacity() + reference.capacity()) * sizeof(double);
}

}  // namespace seif
