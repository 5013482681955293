// Rebuilds, by a replay, what a run folder does not hold: innovations and joint covariances.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "harness/run/live_loop.hpp"
#include "harness/score/rebuilt.hpp"
#include "harness/score/summary.hpp"
#include "harness/score/true_names.hpp"
#include "harness/stream/run_listener.hpp"
#include "seif/registry.hpp"

namespace harness {

/// Follows a replay. It takes the NIS of the first scan after each scoring time, before any filter processes
/// that scan.
class RebuiltConsistency final : public RunListener {
 public:
  /// Keeps references. Scores at most `sample` landmarks of a map, spread evenly.
  RebuiltConsistency(const Believers& believers, const LogDescription& log, int sample);

  void odometry(const OdometryEvent& event) override { note_truth(event.truth); }
  void scan(const ScanEvent& event) override;
  void update(std::size_t estimator, const UpdateRecord& record) override;
  void consistency(std::size_t estimator, const ConsistencyRecord& record) override;
  void scored() override { scan_is_due_ = true; }

  /// One score for each estimator.
  std::vector<RebuiltScore> scores() const;

 private:
  struct Gathered {
    std::vector<double> nis;     // [-] one for each observation
    std::vector<ScanNis> scans;  // one for each scan
    std::vector<double> means;   // [-] NEES from the robot, one for each scoring time
    std::vector<double> last;    // [-] NEES from the robot, one for each landmark at the last scoring time
  };

  void note_truth(const std::optional<TruePose>& truth);
  void add_innovations(const LiveEstimator& estimator, const seif::Scan& scan, Gathered& gathered) const;
  /// The sampled landmarks with a known true position, each with the pair of positions.
  std::vector<std::pair<seif::LandmarkId, PointPair>> sample_of(std::size_t index) const;

  const Believers& believers_;
  const LogDescription& log_;
  std::size_t sample_;  // [-]
  bool scan_is_due_ = false;
  std::optional<seif::Pose2> true_pose_;  // at the last event
  ScanEvent latest_;                      // the latest scan
  std::vector<TrueNames> true_names_;     // one for each estimator
  std::vector<Gathered> gathered_;        // one for each estimator
};

/// The replay differs from the recorded run.
class NotReplayed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How to replay a run.
struct Rebuilding {
  std::filesystem::path run;                // run folder
  std::filesystem::path to;                 // an empty folder
  std::vector<std::string> estimators;      // names in the run, or types
  std::optional<double> interval = {};      // [s] between scoring times; empty: as in the run
  std::vector<std::string> overrides = {};  // of the settings
  bool is_other = false;                    // estimators that the run did not have: nothing to compare with
};

/// Replays a run. `look` sees the estimators when the replay has ended. Throws BadInput, NotReplayed if the
/// replay differs from the record, and std::runtime_error if it was interrupted.
std::vector<RebuiltScore> rebuild(const Rebuilding& rebuilding, const Summary& summary,
                                  const seif::Registry& registry,
                                  const std::function<void(const Believers&)>& look = {});

}  // namespace harness
