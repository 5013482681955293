// The faults of a world, each at its time, between the truth and the stream. They use no random numbers and change
// none, so until its first fault a run is the same as without faults.
#pragma once

#include <optional>
#include <vector>

#include "seif/types.hpp"
#include "worlds/fault.hpp"

namespace harness {

/// The error of the encoders' angles.
struct WheelJumps {
  double left = 0.0;   // [rad]
  double right = 0.0;  // [rad]
};

/// Times are those of the run and must not decrease. [s]
class FaultInjection {
 public:
  explicit FaultInjection(const std::vector<worlds::Fault>& faults);

  /// The pose that the robot is put to now, T_world_robot; each kidnapping is returned once.
  std::optional<worlds::Placement> kidnapping(double t);

  bool is_silent(worlds::FaultySensor sensor, double t) const;

  WheelJumps encoder_jumps(double t) const;

  /// Applies all faults that are due to the first observation of a scan. A fault waits for a scan that saw
  /// something.
  void spoil(seif::Scan& scan);

 private:
  struct Pending {
    worlds::Fault fault;
    bool is_done = false;
  };

  std::vector<Pending> faults_;
};

}  // namespace harness
