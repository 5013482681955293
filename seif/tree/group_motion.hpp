// How a group of landmarks moves: as one body that is also strained evenly. A stiff body would lock: where a closure
// bends the map, the strain is smooth, and stiff pieces of any size resist it.
#pragma once

#include <Eigen/Core>

namespace seif {

/// [x, y, phi, dilation, two shears]: of its middle [m], its turn [rad], and its strain [-] in axes that turn with it.
using GroupMotion = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;

/// How a variable hangs on a group.
struct Lever {
  Eigen::Matrix<double, 2, 1, Eigen::DontAlign> arm{0.0, 0.0};  // from the group's middle to the variable [m]
  double turn = 0.0;                                            // of the group's axes so far [rad]
  double own_turn = 0.0;                                        // of its own, if it is a group [rad]
};

/// Where a unit of dilation, of the first and of the second shear moves the end of the arm. (2 x 3) [m]
Eigen::Matrix<double, 2, 3> strain_columns(const Lever& lever);
/// The shears of a group that hangs on another one, from those of the latter. (2 x 2)
Eigen::Matrix2d shears_of_tied(const Lever& lever);

/// Where the end of the arm goes by a motion of the group. [m] `turning`: along the circle; otherwise along its tangent.
Eigen::Vector2d end_step(const Lever& lever, const GroupMotion& d, bool turning);
/// The motion of a group that hangs on another one.
GroupMotion tied_motion(const Lever& lever, const GroupMotion& d, bool turning);

}  // namespace seif
