// The stream of odometry and scans, from the simulator or from a recorded log, in the order of time. All
// estimators get the same stream, and the recorder writes it. At equal times odometry comes before a scan.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "harness/stream/read_counts.hpp"
#include "seif/types.hpp"

namespace harness {

/// The truth at one time. Only the recorder and the scorer use it.
struct TruePose {
  double t = 0.0;  // [s]
  seif::Pose2 T_world_robot;
  double left_wheel = 0.0;   // [rad] joint angle, unwrapped
  double right_wheel = 0.0;  // [rad] joint angle, unwrapped
};

/// The true position of a landmark.
struct TrueLandmark {
  seif::LandmarkId landmark = seif::no_landmark;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world_landmark [m]
  double radius = 0.0;                                 // [m]
};

struct OdometryEvent {
  seif::Odometry odometry;
  std::optional<TruePose> truth;  // at the same t; empty: not known
};

struct ScanEvent {
  seif::Scan scan;
  std::vector<seif::LandmarkId>
      true_ids;  // one for each observation if they are known; no_landmark: a false detection
  std::optional<TruePose> truth;  // at the same t; empty: not known
};

using Event = std::variant<OdometryEvent, ScanEvent>;

/// A source of events.
class Stream {
 public:
  virtual ~Stream() = default;
  /// Overwrites `event` with the next event; false at the end. Throws if a log cannot be read further.
  virtual bool next(Event& event) = 0;
  /// What was left out of a log so far; zero for streams that leave nothing out.
  virtual ReadCounts counts() const { return {}; }
};

/// A helper for streams. It switches an event between the two kinds and keeps the memory of its scan, so that
/// a stream does not allocate in its steady state.
class ScanMemory {
 public:
  OdometryEvent& odometry(Event& event) {
    if (auto* scan = std::get_if<ScanEvent>(&event)) {
      spare_ = std::move(*scan);
      event.emplace<OdometryEvent>();
    }
    return std::get<OdometryEvent>(event);
  }

  ScanEvent& scan(Event& event) {
    if (std::holds_alternative<OdometryEvent>(event)) event.emplace<ScanEvent>(std::move(spare_));
    return std::get<ScanEvent>(event);
  }

 private:
  ScanEvent spare_;
};

}  // namespace harness
