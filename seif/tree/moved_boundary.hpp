// The boundary of a part of the map that has moved since the part was condensed.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "seif/tree/body_motion.hpp"
#include "seif/tree/group_motion.hpp"
#include "seif/tree/step_jacobian.hpp"

namespace seif {

/// Where a variable of a boundary was and is: a landmark, or the middle of a group.
struct MovedPlace {
  Eigen::Vector2d before, now;  // p_world [m]
  double turn = 0.0;            // of a group, or of the robot [rad]
  double dilation = 0.0;        // of a group [-]
  int rows = 2;                 // 3 of the robot, 4 of a group: [x, y, turn, dilation]

  bool is_turned() const { return rows > 2; }
};

/// How parts of the map turn.
struct Turning {
  bool allowed = true;  // otherwise every part stays as it was turned when it was condensed
  double near = 0.0;    // the distance up to which two landmarks are near each other [m]
};

class MovedBoundary {
 public:
  void begin(const Turning& turning);
  void add(const MovedPlace& place);
  /// Two rows without information.
  void skip() { size_ += 2; }
  const BodyMotion& fit();
  /// All at once.
  const BodyMotion& fit(const Turning& turning, std::span<const MovedPlace> places);

  // After fit():
  const BodyMotion& motion() const { return motion_; }
  /// Of a variable's place, in the frame of the body. [m]
  Eigen::Vector2d step(std::size_t i) const;
  /// The steps of all rows, in the frame of the body, to d.
  void steps(std::span<const MovedPlace> places, Eigen::Ref<Eigen::VectorXd> d) const;
  /// What was known of the part in its own frame, to what it says of where its variables are now.
  void bring(Eigen::Ref<Eigen::MatrixXd> S);
  /// The same for the lower triangle. What stands above it is lost.
  void bring_lower(Eigen::Ref<Eigen::MatrixXd> S);
  void bring_residual(Eigen::Ref<Eigen::VectorXd> r);

 private:
  bool find_jacobian();

  bool turning_ = true;
  BodyMotion motion_;
  BodyFit fit_;
  std::vector<int> rows_;
  std::vector<Eigen::Vector2d> plain_steps_;  // without turning
  int size_ = 0;
  StepJacobian jacobian_;
};

}  // namespace seif
