// The live loop: every event goes to every estimator in turn, and to the listeners of the run.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/score/true_names.hpp"
#include "harness/stream/log_description.hpp"
#include "harness/stream/run_listener.hpp"
#include "harness/stream/screening.hpp"
#include "harness/stream/stream.hpp"
#include "seif/estimator.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// An estimator in a run.
struct LiveEstimator {
  std::string name;
  std::unique_ptr<seif::Estimator> filter;
  double odometry_sd_factor = 1.0;     // [-] what it believes of the noise, over what the data says
  double observation_sd_factor = 1.0;  // [-]
  std::string failure;                 // why it was taken out of the run; empty: it runs
};

/// The name that the world has for a landmark of an estimator's map: its own, if the estimator is told the
/// names.
seif::LandmarkId true_id_of(const seif::Estimator& filter, const TrueNames& names, seif::LandmarkId landmark);

/// Makes the estimators that a world asks for. Each draws from a stream of its own, (seed,
/// "estimator/<name>"). Throws BadInput if a type is not registered, a name stands twice or is not fit for
/// a file name, or an estimator needs names that the log's observations do not have.
std::vector<LiveEstimator> make_estimators(const seif::Registry& registry,
                                           std::span<const worlds::EstimatorChoice> choices,
                                           const LogDescription& log, std::uint64_t seed);

/// Everything that believes to know where the robot is.
struct Believers {
  std::vector<LiveEstimator> estimators;
  seif::Pose2 dead_reckoning;  // T_world_robot by odometry alone, from the same start as the estimators'
};

/// The pose of `pose_from`, odometry or an estimator's name, as it is when asked; empty for the truth. What
/// it returns throws std::runtime_error if there is no such estimator by then, or it has failed, or its pose
/// is not finite. `believers` must live as long.
std::function<seif::Pose2()> steering_pose(const std::string& pose_from, const Believers& believers);

/// What the loop has done so far.
struct LoopCounts {
  std::int64_t updates = 0;  // [-] scans
  std::int64_t events = 0;   // [-]
  double t = 0.0;            // [s] of the last event
  bool interrupted = false;
};

/// Runs estimators on a stream. An update of an estimator is timed from its first motion update since the
/// last scan to the end of its measurement update; listeners and scoring are off that path.
class LiveLoop {
 public:
  /// Keeps references to all. `log` says where the truth about landmarks is.
  LiveLoop(Stream& stream, Believers& believers, std::vector<RunListener*> listeners,
           const LogDescription& log, const worlds::Scoring& scoring);

  /// Until the stream ends or `stop` is set; `progress` is called after each scan. May throw what the stream
  /// throws: finish() is in order then too.
  void run(const std::atomic<bool>& stop, const std::function<void(const LoopCounts&)>& progress);

  /// Scores the consistency at the end and tells of the maps.
  void finish();

  /// Scores the consistency now. At other times than the end, for those who do not want finish().
  void score_consistency();

  const LoopCounts& counts() const { return counts_; }
  /// What was not given to the estimators.
  const Screening& screening() const { return screening_; }

 private:
  using Clock = std::chrono::steady_clock;

  void take(const OdometryEvent& event);
  void take(const ScanEvent& event);
  void note_truth(const std::optional<TruePose>& truth);
  void motion_update(std::size_t index, const seif::Odometry& odometry);
  void measurement_update(std::size_t index, const ScanEvent& event);
  const seif::Scan& scaled(const seif::Scan& scan, double sd_factor);
  ConsistencyRecord consistency_of(std::size_t index) const;
  const TrueLandmark* true_landmark(seif::LandmarkId id) const;
  void tell_map(std::size_t index);

  Stream& stream_;
  Believers& believers_;
  std::vector<RunListener*> listeners_;
  const LogDescription& log_;
  worlds::Scoring scoring_;
  Screening screening_;
  LoopCounts counts_;
  std::int64_t intervals_scored_ = 0;          // [-] since the start
  std::optional<double> last_scoring_t_;       // [s]
  std::optional<seif::Pose2> last_true_pose_;  // at the last event
  std::vector<UpdateTimes> times_;             // of each estimator since the last scan
  std::vector<std::int64_t> blocks_touched_;   // [-] by each estimator until the last scan
  std::vector<TrueNames> true_names_;          // of each estimator that gives names of its own
  seif::Scan scaled_scan_;                     // reused from scan to scan

  // The state of the measurement update that is running.
  seif::StageDone stage_done_;
  UpdateTimes* running_ = nullptr;
  Clock::time_point stage_begin_;
};

}  // namespace harness
