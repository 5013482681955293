// Injects the faults of a world between the truth and the stream, each at its time. Faults use no random
// numbers and do not change those of others. So a run is the same as one without faults until the first
// fault.
#pragma once

#include <optional>
#include <vector>

#include "seif/types.hpp"
#include "worlds/fault.hpp"

namespace harness {

/// Simulated times are whole physics steps. A time in a file is rounded to its decimals. [s]
inline constexpr double time_rounding = 1e-9;

/// The error of the encoders on top of the true angles.
struct WheelJumps {
  double left = 0.0;   // [rad]
  double right = 0.0;  // [rad]
};

/// Times are simulated times and must not decrease. [s]
class FaultInjection {
 public:
  explicit FaultInjection(const std::vector<worlds::Fault>& faults);

  /// Another fault, from now on.
  void add(const worlds::Fault& fault) { faults_.push_back({fault}); }

  /// A sensor that is silent without an end speaks again from `t` on.
  void end_silence(worlds::FaultySensor sensor, double t);

  /// The next thing that appears in the world at `t`: ice, a wall or a landmark, the earliest first. Each is returned
  /// once. Null: no further one.
  const worlds::Fault* thing(double t);

  /// The landmarks among these that thing() has not returned yet, in its order.
  std::vector<worlds::Landmark> landmarks_to_come() const;

  /// The new true pose T_world_robot if the robot is moved away at `t`. Each kidnapping is returned once.
  std::optional<worlds::Placement> kidnapping(double t);

  bool is_silent(worlds::FaultySensor sensor, double t) const;

  WheelJumps encoder_jumps(double t) const;

  /// Spoils the first observation of a scan by all faults that are due. They wait for a scan that has
  /// observations.
  void spoil(seif::Scan& scan);

 private:
  struct Pending {
    worlds::Fault fault;
    bool is_done = false;
  };

  std::vector<Pending> faults_;
};

}  // namespace harness
