// A run that can be taken back to any earlier moment and changed from there.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "harness/live/live_pages.hpp"
#include "harness/live/live_run.hpp"
#include "harness/live/script.hpp"

namespace harness {

class HeldRun {
 public:
  /// Called while the run is simulated again, with the share that is done [-]; false: stop.
  using GoesOn = std::function<bool(double progress)>;

  /// At its beginning. `channels` must outlive it.
  HeldRun(LiveSource source, LiveChannels& channels, GoesOn goes_on);

  LiveRun& run() { return *run_; }
  const LiveRun& run() const { return *run_; }
  const Script& script() const { return script_; }
  const LiveSource& source() const { return source_; }
  std::uint64_t epoch() const { return epoch_; }

  /// Simulates the same run again, up to `t` [s]: the same bits.
  void rewind_to(double t);
  /// From the beginning, without anything that was done.
  void forget_all();

  // Interventions. Each is done at the next physics step, and takes the place of what was to come later. All throw
  // BadInput if it cannot be done; then nothing has changed.

  /// `yaml` is a fault of a world file without its time: "kind: kidnapping, x_m: 1, ..".
  void inject(const std::string& yaml);
  void silence(worlds::FaultySensor sensor, bool begins);
  /// The option changes with the next measurement; also in a recorded log.
  void change_option(const std::string& estimator, const std::string& option, double value);
  void drive(double v, double omega);
  void release();
  /// Another estimator from the beginning on: the run is simulated again. Returns its name.
  std::string add_beside(const std::string& estimator, const std::string& option,
                         const seif::OptionValue& value);

  bool is_by_hand() const;
  /// Whether the sensor says nothing now.
  bool is_silent(worlds::FaultySensor sensor) const;

 private:
  double now_or_later() const;
  double intervention_t();
  void begin_anew();
  void take_over(const worlds::Takeover& row);
  void tell_setting();

  LiveSource source_;
  LiveChannels& channels_;
  GoesOn goes_on_;
  Script script_;
  std::uint64_t epoch_ = 0, version_ = 0;
  std::optional<LiveRun> run_;
};

}  // namespace harness
