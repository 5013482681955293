#include "seif/tree/moved_boundary.hpp"

namespace seif {

void MovedBoundary::begin(const Turning& turning) {
  turning_ = turning.allowed;
  fit_.begin(turning.near);
  motion_ = {};
  rows_.clear();
  plain_steps_.clear();
  size_ = 0;
}

void MovedBoundary::add(const MovedPlace& place) {
  rows_.push_back(size_);
  size_ += place.rows;
  if (!turning_) {
    plain_steps_.push_back(place.now - place.before);
  } else if (place.is_turned()) {
    fit_.add_turned(place.before, place.now, place.turn);
  } else {
    fit_.add(place.before, place.now);
  }
}

const BodyMotion& MovedBoundary::fit() {
  if (turning_) motion_ = fit_.fit();
  return motion_;
}

const BodyMotion& MovedBoundary::fit(const Turning& turning, std::span<const MovedPlace> places) {
  begin(turning);
  for (const MovedPlace& place : places) add(place);
  return fit();
}

Eigen::Vector2d MovedBoundary::step(std::size_t i) const { return turning_ ? fit_.step(i) : plain_steps_[i]; }

void MovedBoundary::steps(std::span<const MovedPlace> places, Eigen::Ref<Eigen::VectorXd> d) const {
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    d.segment<2>(row) = step(i);
    if (places[i].is_turned()) d(row + 2) = places[i].turn - motion_.angle;
    if (places[i].rows > 3) d(row + 3) = places[i].dilation;
    row += places[i].rows;
  }
}

/// None if nothing turns: a step is then the difference of two places.
bool MovedBoundary::find_jacobian() {
  if (turning_) jacobian_.of(fit_, rows_, size_);
  return turning_;
}

void MovedBoundary::bring(Eigen::Ref<Eigen::MatrixXd> S) {
  if (find_jacobian()) jacobian_.bring(S);
}

void MovedBoundary::bring_lower(Eigen::Ref<Eigen::MatrixXd> S) {
  if (find_jacobian()) jacobian_.bring_lower(S);
}

void MovedBoundary::bring_residual(Eigen::Ref<Eigen::VectorXd> r) {
  if (find_jacobian()) jacobian_.bring_residual(r);
}

}  // namespace seif
