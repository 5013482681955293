// Follows a run, and hands snapshots of it to the pages that watch.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "harness/film/sight.hpp"
#include "harness/film/stage.hpp"
#include "harness/live/belief_reader.hpp"
#include "harness/live/exchange.hpp"
#include "harness/live/snapshot.hpp"
#include "harness/live/thrift.hpp"
#include "harness/live/trail_points.hpp"
#include "harness/live/view_wish.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/stream/run_listener.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The run never waits: a snapshot that nobody is ready to take is not made, and making them takes a bounded share
/// of the time.
class LiveObserver final : public RunListener {
 public:
  using Clock = std::chrono::steady_clock;

  /// What it watches, and where the snapshots go. All outlive the observer.
  struct Ends {
    const Believers& believers;
    const LogDescription& log;
    Exchange<LiveSnapshot>& exchange;
    ViewWish& wish;
  };

  /// `knows_world`: the run is of this world. `epoch` is that of its snapshots.
  LiveObserver(const worlds::World& world, bool knows_world, const Ends& ends, std::uint64_t epoch);

  void odometry(const OdometryEvent& event) override;
  void scan(const ScanEvent& event) override;
  void dead_reckoning(double t, const seif::Pose2& T_world_robot) override;
  void update(std::size_t estimator, const UpdateRecord& record) override;
  void consistency(std::size_t estimator, const ConsistencyRecord& record) override;

  /// Publishes a snapshot if the time for one has come. `truth` is the present one, if the caller knows better than
  /// the latest event; `steps` of the physics.
  void publish_if_due(const LiveStatus& status, const std::optional<TruePose>& truth = {},
                      std::int64_t steps = 0);

  /// A landmark was put into the world: the log's landmarks have changed.
  void look_at_landmarks();

 private:
  Clock::duration fill(LiveSnapshot& snapshot, const LiveStatus& status);
  void read_rays(LiveSnapshot& snapshot);

  Ends ends_;
  std::uint64_t epoch_;
  Stage stage_;
  Sight sight_;
  std::deque<BeliefReader> readers_;  // of each estimator
  TrailPoints true_trail_, odometry_trail_;
  Thrift thrift_;
  LiveView view_;
  double t_;                  // [s] of the last event
  std::int64_t updates_ = 0;  // [-]
  std::optional<TruePose> truth_;
  ScanEvent latest_scan_;
  bool has_new_scan_ = false;
};

}  // namespace harness
