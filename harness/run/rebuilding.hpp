// Rebuilds by a replay what the folder of a run does not hold: innovations and joint covariances.
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

/// Listens to a replay. Computes the NIS of the scan after each scoring time, before any filter gets that scan.
class RebuiltConsistency final : public RunListener {
 public:
  /// Keeps references. At most `sample` landmarks of a map are scored, evenly spread.
  RebuiltConsistency(const Believers& believers, const LogDescription& log, int sample);

  void odometry(const OdometryEvent& event) override { note_truth(event.truth); }
  void scan(const ScanEvent& event) override;
  void update(std::size_t estimator, const UpdateRecord& record) override;
  void consistency(std::size_t estimator, const ConsistencyRecord& record) override;
  void scored() override { scan_is_due_ = true; }

  /// One for each estimator.
  std::vector<RebuiltScore> scores() const;

 private:
  struct Gathered {
    std::vector<double> nis;     // [-] of each observation
    std::vector<ScanNis> scans;  // of each scan
    std::vector<double> means;   // [-] from the robot, of each scoring time
    std::vector<double> last;    // [-] from the robot, of each landmark at the last one
  };

  void note_truth(const std::optional<TruePose>& truth);
  void add_innovations(const LiveEstimator& estimator, const seif::Scan& scan, Gathered& gathered) const;
  /// The sample of landmarks whose truth is known, beside it.
  std::vector<std::pair<seif::LandmarkId, PointPair>> sample_of(std::size_t index) const;

  const Believers& believers_;
  const LogDescription& log_;
  std::size_t sample_;  // [-]
  bool scan_is_due_ = false;
  std::optional<seif::Pose2> true_pose_;    // at the last event
  std::vector<seif::LandmarkId> true_ids_;  // of the latest scan
  std::vector<TrueNames> true_names_;       // by estimator
  std::vector<Gathered> gathered_;          // by estimator
};

/// Thrown if a replay does not give the recorded estimates.
class NotReplayed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How to replay a run.
struct Rebuilding {
  std::filesystem::path run;                // the folder of the run
  std::filesystem::path to;                 // an empty folder
  std::vector<std::string> estimators;      // by their names in the run, or types
  std::optional<double> interval = {};      // [s] between scoring times; nothing: the run's
  std::vector<std::string> overrides = {};  // of the settings
  bool is_other = false;                    // estimators that are not the run's: nothing recorded to come to
};

/// Replays a run; `look` sees the estimators in their final state. Throws BadInput, NotReplayed, and
/// std::runtime_error if it was interrupted.
std::vector<RebuiltScore> rebuild(const Rebuilding& rebuilding, const Summary& summary,
                                  const seif::Registry& registry,
                                  const std::function<void(const Believers&)>& look = {});

}  // namespace harness
