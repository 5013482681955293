#include "seif/tree/leaf_element.hpp"

#include <algorithm>

#include "seif/tree/room.hpp"

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

void ElementMover::turn(const BodyMotion& motion, Condensed& element) {
  if (motion.is_identity() || element.b == 0) return;
  make_room(square_, Eigen::Index{element.b} * element.b);
  Eigen::Map<Eigen::MatrixXd> S(square_.data(), element.b, element.b);
  element.unpack(S);
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

void ElementMover::carry(const Turning& turning, std::span<const MovedPlace> places, Condensed& element) {
  moved_.bring(turning, places, element);
  std::copy_n(moved_.S(), element.S.size(), element.S.data());
  element.s.assign(moved_.r(), moved_.r() + element.b);
  double* reference = element.reference.data();
  for (const MovedPlace& place : places) reference = std::copy_n(place.now.data(), 2, reference);
}

}  // namespace seif
