// What goes wrong on purpose between the truth and the stream: the faults of a world, each at its time. They
// draw nothing at random and change nothing that is drawn, so a run is the same up to its first fault as
// without.
#pragma once

#include <optional>
#include <vector>

#include "seif/types.hpp"
#include "worlds/fault.hpp"

namespace harness {

/// What the encoders read beyond the true angles.
struct WheelJumps {
  double left = 0.0;   // [rad]
  double right = 0.0;  // [rad]
};

/// Times are those of the run and must not decrease. [s]
class FaultInjection {
 public:
  explicit FaultInjection(const std::vector<worlds::Fault>& faults);

  /// Where the robot is put now; each kidnapping is told once. T_world_robot.
  std::optional<worlds::Placement> kidnapping(double t);

  bool is_silent(worlds::FaultySensor sensor, double t) const;

  WheelJumps encoder_jumps(double t) const;

  /// Spoils the first observation of a scan, by all faults that are due; they wait for one that saw
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
