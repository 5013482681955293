// How a group of landmarks moves: as one body whose size may change. A stiff body would lock: where a closure bends
// the map, stiff pieces of any size resist it.
#pragma once

#include <Eigen/Core>

namespace seif {

/// [x, y, phi, dilation]: of its middle [m], its turn [rad], and how much larger it is [-].
using GroupMotion = Eigen::Matrix<double, 4, 1, Eigen::DontAlign>;
/// From the middle of a group to what hangs on it. [m]
using Lever = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;

/// Where the end of the lever goes by a motion of the group. [m] `turning`: along the circle; otherwise along its
/// tangent.
Eigen::Vector2d end_step(const Lever& lever, const GroupMotion& d, bool turning);
/// The motion of a group that hangs on another one.
GroupMotion tied_motion(const Lever& lever, const GroupMotion& d, bool turning);

}  // namespace seif
