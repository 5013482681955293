#include "seif/tree/moved_boundary.hpp"

namespace seif {

void MovedBoundary::begin(double near) {
  fit_.begin(near);
  rows_.clear();
  size_ = 0;
}

void MovedBoundary::add(const MovedPlace& place) {
  rows_.push_back(size_);
  size_ += place.is_group ? 3 : 2;
  if (place.is_group) {
    fit_.add_turned(place.before, place.now, place.turn);
  } else {
    fit_.add(place.before, place.now);
  }
}

const BodyMotion& MovedBoundary::fit(double near, std::span<const MovedPlace> places) {
  begin(near);
  for (const MovedPlace& place : places) add(place);
  return fit();
}

}  // namespace seif
