#include "seif/linearisation_noise.hpp"

#include <algorithm>

namespace seif {
namespace {

constexpr double nearest_range = 0.01;  // [m] as in models.cpp: a nearer landmark has no direction

// [rad^2] Without it seif is overconfident where ranges are good to 0.1 mm and bearings to 0.001 degrees.
constexpr double least_heading_variance = 1e-4;

/// The lever about which the heading turns the landmark: perpendicular to the vector from pose to landmark.
Eigen::Vector2d turned(const ObservationFactor& factor) {
  return {factor.m0.y() - factor.x0.y, factor.x0.x - factor.m0.x()};
}

/// How far J_x's column for the heading is from that of the means. [m/rad, -]
Eigen::Vector2d lever_error(const ObservationFactor& factor) {
  return factor.J_x.col(2) - factor.J_m * turned(factor);
}

/// C along and across the direction, and its mixed entry. [m^2]
struct Spread {
  double along, across, mixed;
};

Eigen::Vector2d second_order(const Spread& C, double distance, double V) {
  const double d2 = distance * distance;
  return {0.75 * C.across * C.across / d2 + V * C.across,
          (C.along * C.across + 2.0 * C.mixed * C.mixed) / (d2 * d2) + V * C.along / d2};
}

}  // namespace

Eigen::Vector2d linearisation_noise(const InformationState& state, const ObservationFactor& factor,
                                    const WindowFactor& window,
                                    Eigen::Matrix<double, Eigen::Dynamic, 3>& scratch) {
  if (scratch.rows() < window.size) scratch.resize(2 * window.size, 3);
  const int row = InformationState::row_of(state.position(factor.slot));
  auto Y = scratch.topRows(window.size);  // L^-1 times [dm - dx - dtheta (m - x turned) | dtheta]
  Y.setZero();
  Y.topLeftCorner<2, 2>() = -Eigen::Matrix2d::Identity();
  Y.block<1, 2>(2, 0) = turned(factor).transpose();
  Y.block<2, 2>(row, 0).setIdentity();
  Y(2, 2) = 1.0;
  window.L().triangularView<Eigen::Lower>().solveInPlace(Y);
  const Eigen::Matrix2d C = Y.leftCols<2>().transpose() * Y.leftCols<2>();
  const double V = std::max(Y.col(2).squaredNorm(), least_heading_variance);

  const Eigen::Vector2d along = factor.J_m.row(0).transpose();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Spread spread{along.dot(C * along), across.dot(C * across), along.dot(C * across)};
  const double distance = 1.0 / factor.J_m.row(1).norm();
  return second_order(spread, distance, V) + V * lever_error(factor).cwiseAbs2();
}

Eigen::Vector2d linearisation_noise(const Observation& observation, double V) {
  const double d = std::max(observation.range, nearest_range);
  const Eigen::Matrix2d& Q = observation.covariance;
  return second_order({Q(0, 0), d * d * Q(1, 1), d * Q(0, 1)}, d, V);
}

Eigen::Vector2d rough_linearisation_noise(const ObservationFactor& factor, double V) {
  constexpr double most_squared = 9.0;  // [sigma^2] that the sensor alone explains
  const double d = std::max(factor.observation.range, nearest_range);
  const Eigen::Vector2d Q = factor.observation.covariance.diagonal();
  const Eigen::Vector2d squared = Q.cwiseMax(factor.v.cwiseAbs2());
  const Eigen::Vector2d excess = (factor.v.cwiseAbs2() - most_squared * Q).cwiseMax(0.0);
  const Eigen::Vector2d turned_by_heading(d * d * excess(1), excess(0) / (d * d));
  return second_order({squared(0), d * d * squared(1), 0.0}, d, 0.0) +
         V * (turned_by_heading + lever_error(factor).cwiseAbs2());
}

double heading_variance(const WindowFactor& window, Eigen::Matrix<double, Eigen::Dynamic, 3>& scratch) {
  if (scratch.rows() < window.size) scratch.resize(2 * window.size, 3);
  auto y = scratch.col(0).head(window.size);
  y.setZero();
  y(2) = 1.0;
  window.L().triangularView<Eigen::Lower>().solveInPlace(y);
  return std::max(y.squaredNorm(), least_heading_variance);
}

}  // namespace seif
