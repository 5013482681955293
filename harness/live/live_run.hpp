// A run that is driven step by step: its stream, its estimators, its record, and who watches it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/live/inspection.hpp"
#include "harness/live/live_observer.hpp"
#include "harness/live/live_pages.hpp"
#include "harness/recording/recorder.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// Where a run comes from.
struct LiveSource {
  worlds::World world;           // for a log: the settings of its replay
  std::string resolved;          // the text of the world
  bool knows_world = true;       // false: a log whose world is not known
  std::optional<LogChoice> log;  // empty: the world is simulated
  const seif::Registry& registry;
};

class LiveRun {
 public:
  using Advance = SimulatedStream::Advance;

  /// A run of `world` from its beginning; the rest as `source` says. Throws what prepare_run() throws.
  LiveRun(const LiveSource& source, const worlds::World& world, LiveChannels& channels, std::uint64_t epoch);

  /// One physics step, or one measurement that is due: all estimators process it. A log has measurements only.
  /// Throws if a log cannot be read on, or the record cannot be written.
  Advance advance();
  /// Processes the measurements that are due already.
  void settle();

  bool is_simulated() const { return simulation_ != nullptr; }
  SimulatedStream& simulation() { return *simulation_; }
  const SimulatedStream& simulation() const { return *simulation_; }
  LiveLoop& loop() { return *loop_; }
  const Believers& believers() const { return *run_.believers; }
  const LogDescription& log() const { return *run_.log; }
  /// The scan that is being processed, or was last.
  const seif::Scan& latest_scan() const { return latest_scan_; }
  const SightingLog& sightings() const { return sightings_; }
  LiveObserver& observer() { return observer_.value(); }

  double t() const;            // [s] now
  std::int64_t steps() const;  // [-] of the physics; of a log: its events
  std::int64_t updates() const { return loop_->counts().updates; }
  void publish(const LiveStatus& status);

  /// The trajectory hash that a run which ended now would have. Writes the maps to the record.
  std::string hash_so_far();

 private:
  PreparedRun run_;
  SimulatedStream* simulation_;  // of `run_`; null for a log
  TemporaryFolder folder_;
  std::optional<Recorder> recorder_;
  std::optional<LiveObserver> observer_;
  std::optional<LiveLoop> loop_;
  Event event_;
  seif::Scan latest_scan_;
  SightingLog sightings_;
};

}  // namespace harness
