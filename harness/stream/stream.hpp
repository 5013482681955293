// The stream of odometry and scans, from the simulator or from a recorded log. Every estimator gets it, and the
// recorder writes it, in the order of time. At equal times odometry comes before a scan.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "harness/stream/read_counts.hpp"
#include "seif/types.hpp"

namespace harness {

/// The truth at one moment. For the recorder and the scorer alone.
struct TruePose {
  double t = 0.0;  // [s]
  seif::Pose2 T_world_robot;
  double left_wheel = 0.0;   // [rad] joint angle, unwrapped
  double right_wheel = 0.0;  // [rad] joint angle, unwrapped
};

/// A landmark as it really is.
struct TrueLandmark {
  seif::LandmarkId landmark = seif::no_landmark;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world_landmark [m]
  double radius = 0.0;                                 // [m]
};

struct OdometryEvent {
  seif::Odometry odometry;
  std::optional<TruePose> truth;  // at the same t, where it is known
};

struct ScanEvent {
  seif::Scan scan;
  std::vector<seif::LandmarkId>
      true_ids;  // one for each observation where they are known; no_landmark: a false detection
  std::optional<TruePose> truth;  // at the same t, where it is known
};

using Event = std::variant<OdometryEvent, ScanEvent>;

/// A source of events.
class Stream {
 public:
  virtual ~Stream() = default;
  /// The next event, written over `event`; false at the end. Throws on a log that cannot be read further.
  virtual bool next(Event& event) = 0;
  /// What was ignored of a log so far, for streams that ignore something.
  virtual ReadCounts counts() const { return {}; }
};

/// For streams: turns an event from one kind into the other and keeps the memory of its scan meanwhile, so
/// that a stream in its steady state does not allocate.
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
