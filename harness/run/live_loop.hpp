// The live loop: gives every event to every estimator in turn, and to the listeners of the run.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/run/live_estimator.hpp"
#include "harness/run/option_changes.hpp"
#include "harness/score/true_names.hpp"
#include "harness/stream/log_description.hpp"
#include "harness/stream/run_listener.hpp"
#include "harness/stream/screening.hpp"
#include "harness/stream/stream.hpp"
#include "seif/estimator.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The world's id of a landmark in an estimator's map. If the estimator is told the ids, it is `landmark`
/// itself.
seif::LandmarkId true_id_of(const seif::Estimator& filter, const TrueNames& names, seif::LandmarkId landmark);

/// Makes the estimators that a world asks for. Each has a random stream of its own, (seed, "estimator/NAME").
/// Throws BadInput if a type is not registered, if a name occurs twice or cannot be a file name, or if an
/// estimator needs landmark ids that the log does not have.
std::vector<LiveEstimator> make_estimators(const seif::Registry& registry,
                                           std::span<const worlds::EstimatorChoice> choices,
                                           const LogDescription& log, std::uint64_t seed);

/// Everything that has a belief about the robot's pose.
struct Believers {
  std::vector<LiveEstimator> estimators;
  seif::Pose2 dead_reckoning;  // T_world_robot by odometry only, from the same start as the estimators
};

/// A function that gives the present pose by `pose_from`: odometry or the name of an estimator. Empty for the
/// truth. The function throws std::runtime_error if the estimator does not exist, has failed, or has a pose
/// that is not finite. `believers` must outlive the function.
std::function<seif::Pose2()> steering_pose(const std::string& pose_from, const Believers& believers);

/// What the loop has done so far.
struct LoopCounts {
  std::int64_t updates = 0;  // [-] scans
  std::int64_t events = 0;   // [-]
  double t = 0.0;            // [s] of the last event
  bool interrupted = false;
};

/// Runs estimators on a stream. The time of an update counts from the first motion update since the last scan
/// to the end of the measurement update. The time of listeners and of scoring is not part of it.
class LiveLoop {
 public:
  /// Keeps references to all arguments. `log` holds the true landmarks.
  LiveLoop(Stream& stream, Believers& believers, std::vector<RunListener*> listeners,
           const LogDescription& log, const worlds::Scoring& scoring);

  /// Runs until the stream ends or `stop` is set. Calls `progress` after each scan. Passes on what the stream
  /// throws; call finish() in that case too.
  void run(const std::atomic<bool>& stop, const std::function<void(const LoopCounts&)>& progress);

  /// Processes one event, which may lose what is invalid. False if nothing of it was left.
  bool take(Event& event);

  /// Scores the consistency at the end and reports the maps.
  void finish();

  /// Changes an option of an estimator before the first event that is later than `change.at`.
  void change(const OptionChange& change) { changes_.add(change); }

  /// From now on calls `watch` with the index of an estimator and a stage of its update: before the measurement
  /// update with Stage::motion, and then whenever a stage has ended. What the call takes is no part of the
  /// times that are recorded. It may read the estimators, and may not change them.
  void watch_stages(std::function<void(std::size_t, seif::Stage)> watch) { watch_ = std::move(watch); }

  /// Scores the consistency now. For callers that do not want finish().
  void score_consistency();

  const LoopCounts& counts() const { return counts_; }
  /// What the estimators were not given.
  const Screening& screening() const { return screening_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// The measurement update in progress.
  struct Running {
    std::size_t estimator = 0;
    Clock::time_point stage_begin;
    Clock::duration watched{};  // spent in watch_
  };

  void end_stage(seif::Stage done);
  void take(const OdometryEvent& event);
  void take(const ScanEvent& event);
  void note_truth(const std::optional<TruePose>& truth);
  void motion_update(std::size_t index, const seif::Odometry& odometry);
  void measurement_update(std::size_t index, const ScanEvent& event);
  UpdateRecord record_of(std::size_t index, const ScanEvent& event);
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
  bool frame_is_known_ = false;                // the true pose is known at the start, or at the first event
  std::vector<UpdateTimes> times_;             // for each estimator, since the last scan
  std::vector<std::int64_t> blocks_touched_;   // [-] for each estimator, up to the last scan
  std::vector<TrueNames> true_names_;          // for each estimator that names landmarks by itself
  seif::Scan scaled_scan_;                     // reused from scan to scan

  OptionChanges changes_;
  seif::StageDone stage_done_;
  std::function<void(std::size_t, seif::Stage)> watch_;  // empty: nobody watches
  Running running_;
};

}  // namespace harness
