// The boundary of a part of the map that has moved since the part was condensed.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "seif/tree/body_motion.hpp"
#include "seif/tree/step_jacobian.hpp"

namespace seif {

/// Where a variable of a boundary was and is: a landmark, or the middle of a group.
struct MovedPlace {
  Eigen::Vector2d before, now;  // p_world [m]
  double turn = 0.0;            // of a group [rad]
  bool is_group = false;
};

class MovedBoundary {
 public:
  /// `near`: the distance up to which two landmarks are near each other [m].
  void begin(double near);
  void add(const MovedPlace& place);
  /// Two rows without information.
  void skip() { size_ += 2; }
  const BodyMotion& fit() { return fit_.fit(); }
  /// All at once.
  const BodyMotion& fit(double near, std::span<const MovedPlace> places);

  // After fit():
  const BodyMotion& motion() const { return fit_.motion(); }
  /// Of a variable's place, in the frame of the body. [m]
  Eigen::Vector2d step(std::size_t i) const { return fit_.step(i); }
  /// What was known of the part in its own frame, to what it says of where its variables are now.
  void bring(Eigen::Ref<Eigen::MatrixXd> S) {
    jacobian_.of(fit_, rows_, size_);
    jacobian_.bring(S);
  }
  void bring_residual(Eigen::Ref<Eigen::VectorXd> r) {
    jacobian_.of(fit_, rows_, size_);
    jacobian_.bring_residual(r);
  }

 private:
  BodyFit fit_;
  std::vector<int> rows_;
  int size_ = 0;
  StepJacobian jacobian_;
};

}  // namespace seif
