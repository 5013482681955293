// MRPT's range-bearing EKF-SLAM behind an interface of plain numbers, which keeps MRPT's headers in one file.
#pragma once

#include <array>
#include <memory>
#include <span>

namespace peers {

/// A pose, or a motion since the last pose.
struct Gaussian {
  std::array<double, 3> mean = {};        // x y theta [m, m, rad]
  std::array<double, 9> covariance = {};  // (3 x 3) [m, rad]
};

struct Sighting {
  int landmark = 0;
  double range = 0.0;    // [m]
  double bearing = 0.0;  // [rad]
};

/// MRPT uses one measurement noise for all observations.
struct SensorNoise {
  double range_sd = 0.0;    // [m]
  double bearing_sd = 0.0;  // [rad]
};

struct MrptSetup {
  Gaussian start;                              // T_world_robot
  std::array<double, 3> sensor_on_robot = {};  // T_robot_sensor: x y theta [m, m, rad]
  bool one_scalar_at_once = false;             // kfEKFAlaDavison instead of kfEKFNaive
};

/// All of its functions are virtual, so that only make_mrpt_filter() has to be exported. The state is [x y theta m1x m1y ...], with the landmarks in the order in which they joined it.
class MrptFilter {
 public:
  virtual ~MrptFilter() = default;

  /// Processes the motion since the last update, and the observations after it, of at least one landmark.
  virtual void update(const Gaussian& motion, std::span<const Sighting> seen, const SensorNoise& noise) = 0;

  virtual std::span<const double> mean() const = 0;
  virtual double covariance(int row, int column) const = 0;

  /// The number of the landmark at a place in the state, from 0.
  virtual int landmark_at(int place) const = 0;
};

std::unique_ptr<MrptFilter> make_mrpt_filter(const MrptSetup& setup);

}  // namespace peers
