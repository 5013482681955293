#include "sensors/wheel_arc.hpp"

#include <cmath>

namespace sensors {

namespace {

/// sin(x) / x and its derivative.
struct Sinc {
  double value;
  double derivative;
};

Sinc sinc(double x) {
  // Below this the omitted terms of the series, x^6 / 5040 and x^5 / 840, are smaller than the rounding of the
  // sum. The closed form of the derivative would lose digits to cancellation there.
  constexpr double series_below = 1e-3;
  if (std::abs(x) < series_below) {
    const double x2 = x * x;
    return {1.0 - x2 / 6.0 * (1.0 - x2 / 20.0), -x / 3.0 * (1.0 - x2 / 10.0)};
  }
  const double value = std::sin(x) / x;
  return {value, (std::cos(x) - value) / x};
}

}  // namespace

WheelArc wheel_arc(const WheelDistances& distances, double track) {
  const double d = 0.5 * (distances.left + distances.right);
  const double turn = (distances.right - distances.left) / track;
  // An arc of length d that turns by 2 h has a chord of length d sin(h) / h, which starts at the angle h.
  const double h = 0.5 * turn;
  const double c = std::cos(h);
  const double s = std::sin(h);
  const Sinc f = sinc(h);

  WheelArc arc;
  arc.T_start_end = {d * f.value * c, d * f.value * s, seif::wrap_angle(turn)};

  Eigen::Matrix<double, 3, 2> J_arc_wrt_length_turn;
  J_arc_wrt_length_turn << f.value * c, 0.5 * d * (f.derivative * c - f.value * s),  //
      f.value * s, 0.5 * d * (f.derivative * s + f.value * c),                       //
      0.0, 1.0;
  Eigen::Matrix2d J_length_turn_wrt_wheels;
  J_length_turn_wrt_wheels << 0.5, 0.5,  //
      -1.0 / track, 1.0 / track;
  arc.J_arc_wrt_wheels = J_arc_wrt_length_turn * J_length_turn_wrt_wheels;
  return arc;
}

}  // namespace sensors
