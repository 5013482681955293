#include "seif/tree/moved_part.hpp"

#include "seif/packed_triangle.hpp"
#include "seif/tree/room.hpp"

namespace seif {

void MovedPart::bring(const Turning& turning, std::span<const MovedPlace> places, const Condensed& part) {
  const Eigen::Index b = part.b;
  make_room(square_, b * b);
  make_room(packed_, b * (b + 1) / 2);
  make_room(d_, b);
  make_room(r_, b);
  boundary_.fit(turning, places);
  auto d = d_.head(b);
  auto r = r_.head(b);
  boundary_.steps(places, d);
  Eigen::Map<Eigen::MatrixXd> S(square_.data(), b, b);
  unpack_lower_triangle(part.S.data(), S);
  r = Eigen::Map<const Eigen::VectorXd>(part.s.data(), b);
  r.noalias() -= S.selfadjointView<Eigen::Lower>() * d;
  boundary_.bring_lower(S);
  boundary_.bring_residual(r);
  pack_triangle(S, packed_.data());
}

}  // namespace seif
