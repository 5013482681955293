#include "seif/tree/leaf_element.hpp"

#include <algorithm>

namespace seif {

void grow(ArrayPool& pool, Condensed& element) {
  const auto before = static_cast<std::ptrdiff_t>(element.reference.size());
  const auto now = static_cast<std::ptrdiff_t>(2 * element.boundary.size());
  if (now == before) return;
  ArrayPool::Array S = pool.take(static_cast<std::size_t>(now * (now + 1) / 2));
  std::fill_n(S.data(), S.size(), 0.0);
  const double* from = element.S.data();
  double* to = S.data();
  for (std::ptrdiff_t col = 0; col < before; ++col) {
    std::copy_n(from, before - col, to);
    from += before - col;
    to += now - col;
  }
  element.S = std::move(S);
  element.b = static_cast<int>(now);
  element.reference.resize(static_cast<std::size_t>(now));
  element.s.resize(static_cast<std::size_t>(now), 0.0);
}

Eigen::Map<Eigen::MatrixXd> ElementMover::unpacked(const Condensed& element) {
  const Eigen::Index b = element.b;
  if (square_.size() < b * b) square_.resize(2 * b * b);
  Eigen::Map<Eigen::MatrixXd> S(square_.data(), b, b);
  element.unpack(S);
  return S;
}

void ElementMover::turn(const BodyMotion& motion, Condensed& element) {
  if (motion.is_identity() || element.b == 0) return;
  auto S = unpacked(element);
  for (int row = 0; row < element.b; row += 2) {
    for (int k = 0; k < element.b; ++k) S.block<2, 1>(row, k) = (motion.R * S.block<2, 1>(row, k)).eval();
  }
  for (int row = 0; row < element.b; row += 2) {
    for (int k = 0; k < element.b; ++k)
      S.block<1, 2>(k, row) = (S.block<1, 2>(k, row) * motion.R.transpose()).eval();
    Eigen::Map<Eigen::Vector2d> reference(&element.reference[static_cast<std::size_t>(row)]);
    Eigen::Map<Eigen::Vector2d> s(&element.s[static_cast<std::size_t>(row)]);
    reference = motion.moved(reference);
    s = (motion.R * s).eval();
  }
  element.pack(S);
}

void ElementMover::carry(MovedBoundary& moved, std::span<const MovedPlace> places,
                         const Eigen::Ref<const Eigen::VectorXd>& r, Condensed& element) {
  auto S = unpacked(element);
  moved.bring(S);
  element.pack(S);
  for (int i = 0; i < element.b / 2; ++i) {
    const Eigen::Vector2d& p = places[static_cast<std::size_t>(i)].now;
    Eigen::Map<Eigen::Vector2d>(&element.reference[static_cast<std::size_t>(2 * i)]) = p;
    Eigen::Map<Eigen::Vector2d>(&element.s[static_cast<std::size_t>(2 * i)]) = r.segment<2>(2 * i);
  }
}

}  // namespace seif
