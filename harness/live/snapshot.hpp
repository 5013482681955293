// What the pages of a live run show, as plain values: written by the thread of the run, read by that of the pages.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/stream/stream.hpp"
#include "seif/types.hpp"

namespace harness {

/// A point of the ground, or the mean of a landmark. [m]
struct LivePoint {
  float x = 0.0F;
  float y = 0.0F;
};

struct LiveMean {
  seif::LandmarkId landmark = seif::no_landmark;
  LivePoint p;  // p_world_landmark
};

/// The covariance of a landmark. [m^2]
struct LiveEllipse {
  seif::LandmarkId landmark = seif::no_landmark;
  float xx = 0.0F, xy = 0.0F, yy = 0.0F;
};

struct LiveLink {
  seif::LandmarkId from = seif::no_landmark;
  seif::LandmarkId to = seif::no_landmark;
  float weight = 0.0F;  // [-] in [0, 1]
};

/// A ray of the latest scan.
struct LiveRay {
  enum class Kind { seen, hidden, false_detection };
  LivePoint end;
  Kind kind = Kind::seen;
};

/// The charts at one update; NaN where a value is not known.
struct LiveChartPoint {
  float t = 0.0F;                                               // [s]
  float update_us = 0.0F;                                       // [us]
  float error = std::numeric_limits<float>::quiet_NaN();        // [m] of the position
  float three_sigma = std::numeric_limits<float>::quiet_NaN();  // [m] of the position, its longest axis
  float nees = std::numeric_limits<float>::quiet_NaN();         // [-] of the pose, for each degree of freedom
};

/// The matrix of an estimator as a picture.
struct LiveMatrix {
  int size = 0;                        // [-] cells along an edge; 0: none
  double fill = 0.0;                   // [-] share of blocks that are not zero
  std::vector<std::uint8_t> darkness;  // (size x size) 0: white, 255: black
};

/// The figures of an estimator that one looks at while it runs.
struct LiveFigures {
  double update_us = 0.0;             // [us] the latest update
  double p50_us = 0.0, p99_us = 0.0;  // [us] of all updates so far
  std::optional<double> error;        // [m] of the position
  std::optional<double> rmse;         // [m] of the position, so far
  std::optional<double> three_sigma;  // [m]
  std::optional<double> nees;         // [-] of the pose, the latest
  std::optional<double> nees_map;     // [-] of the landmarks, the latest scored
  std::int64_t links = 0;             // [-]
  std::int64_t active = 0;            // [-]
  std::int64_t landmarks = 0;         // [-]
  std::int64_t memory_bytes = 0;      // [byte]
};

struct LiveBelief {
  seif::Pose2 pose;
  std::optional<Eigen::Matrix3d> covariance;  // (3 x 3) of the pose
  std::string failure;                        // empty: it runs
  LiveFigures figures;
  std::vector<LiveMean> means;                 // those that have changed since the last snapshot
  std::vector<LiveEllipse> ellipses;           // the same
  std::vector<seif::LandmarkId> active;        // all
  std::optional<std::vector<LiveLink>> links;  // those to draw; empty: as before
  std::vector<LivePoint> trail;                // since the last snapshot
  std::vector<LiveChartPoint> charts;          // since the last snapshot
};

enum class LiveState { running, paused, stage, rewinding, ended };

/// What the run is doing, and who holds it.
struct LiveStatus {
  LiveState state = LiveState::running;
  double progress = 0.0;  // [-] of a rewinding, in [0, 1]
  double speed = 1.0;     // [-] simulated time over time; infinity: as fast as it goes
  double realtime = 0.0;  // [-] the same, as measured
  bool by_hand = false;   // somebody drives
  bool is_blind = false;  // the landmark sensor says nothing
  bool is_numb = false;   // the encoders say nothing
  std::string watched;    // the estimator whose stages and matrix are shown
  bool is_idle = false;   // the run has nothing to do just now: looking at it takes nothing from it
};

struct LiveSnapshot {
  std::uint64_t epoch = 0;   // one more each time that the run begins anew
  double t = 0.0;            // [s]
  std::int64_t steps = 0;    // [-] of the physics
  std::int64_t updates = 0;  // [-]
  LiveStatus status;
  std::optional<TruePose> truth;
  seif::Pose2 odometry;  // T_world_robot by odometry alone
  std::vector<LiveRay> rays;
  std::vector<LivePoint> true_trail;      // since the last snapshot
  std::vector<LivePoint> odometry_trail;  // the same
  std::vector<LiveBelief> beliefs;
  std::optional<LiveMatrix> matrix;  // of the watched estimator; empty: as before
};

}  // namespace harness
