// A range-bearing landmark sensor with field of view, occlusion, noise, misses, false detections, and ids that
// are misread or hidden.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "seif/types.hpp"

namespace sensors {

struct LandmarkSensorOptions {
  seif::Pose2 T_robot_sensor;
  double max_range = 8.0;               // [m] to the landmark's centre
  double fov = 2.0 * std::numbers::pi;  // [rad] field of view: full angle, centred on the sensor's x
  double range_sd = 0.05;               // [m]
  double range_sd_per_m = 0.0;          // [-] part of the sd that grows with range, added in quadrature
  double bearing_sd = 0.0087;           // [rad]
  double miss_probability = 0.0;        // [-] of a visible landmark not being reported
  double false_detections = 0.0;        // [-] mean number in a scan (Poisson)
  seif::LandmarkId first_false_id = 0;  // false detections get ids from here on; landmarks' ids are smaller
  double misread_probability = 0.0;     // [-] of an observation having another landmark's id
  bool hides_ids = false;               // observations have no id
};

/// A landmark that may be in view.
struct LandmarkTruth {
  seif::LandmarkId landmark = seif::no_landmark;
  Eigen::Vector2d p_world = Eigen::Vector2d::Zero();  // [m] of its centre
};

/// Whether the line from the sensor to the landmark is free.
using LineOfSight = std::function<bool(const Eigen::Vector2d& p_world_sensor, seif::LandmarkId)>;

class LandmarkSensor {
 public:
  /// Throws std::invalid_argument if a standard deviation, range or field of view is not positive (an
  /// observation's covariance must be positive definite), or a probability or rate is out of its bounds.
  LandmarkSensor(const LandmarkSensorOptions& options, std::mt19937_64 random);

  /// Fills `scan` with the observations from the true pose. `candidates` holds at least every landmark within
  /// range, in a fixed order. `true_ids` gets the true landmark of each observation, whatever id the
  /// observation has; no_landmark for a false detection. All ids in a scan are different. The landmarks come
  /// first, in the order of the candidates, then the false detections. Allocates only while the vectors still
  /// grow.
  void scan(double t, const seif::Pose2& T_world_robot, std::span<const LandmarkTruth> candidates,
            const LineOfSight& line_of_sight, seif::Scan& scan, std::vector<seif::LandmarkId>& true_ids);

 private:
  seif::Observation observation(seif::LandmarkId landmark, double range, double bearing) const;
  void detect(const LandmarkTruth& truth, double range, double bearing, seif::Scan& scan,
              std::vector<seif::LandmarkId>& true_ids);
  void misread_ids(seif::Scan& scan) const;
  void detect_falsely(seif::Scan& scan, std::vector<seif::LandmarkId>& true_ids);
  double range_variance(double range) const;

  LandmarkSensorOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> standard_normal_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  seif::LandmarkId next_false_id_ = 0;
  struct Misreading {
    std::size_t observation;
    seif::LandmarkId drawn;
  };
  std::vector<Misreading> misreadings_;  // of the latest scan
};

}  // namespace sensors
