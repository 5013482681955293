#include "harness/stream/truth_track.hpp"

namespace harness {

namespace {

double between(double a, double b, double share) { return a + share * (b - a); }

}  // namespace

TruePose interpolate(const TruePose& a, const TruePose& b, double t) {
  const double share = (t - a.t) / (b.t - a.t);
  const seif::Pose2& from = a.T_world_robot;
  const seif::Pose2& to = b.T_world_robot;
  const double turn = seif::wrap_angle(to.theta - from.theta);
  return {t,
          {between(from.x, to.x, share), between(from.y, to.y, share),
           seif::wrap_angle(from.theta + share * turn)},
          between(a.left_wheel, b.left_wheel, share),
          between(a.right_wheel, b.right_wheel, share)};
}

}  // namespace harness
