// A run in the hands of its pages: paused, stepped, taken back, and meddled with. All that is done is recorded.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/live/held_run.hpp"
#include "harness/live/live_pages.hpp"
#include "harness/live/pacer.hpp"
#include "harness/live/stage_show.hpp"

namespace harness {

/// What a page wants to have saved: what was done up to `t`.
struct SaveOrder {
  PageId page = 0;
  std::int64_t seq = 0;
  std::string what;   // run, film or report
  std::string world;  // its name
  double t = 0.0;     // [s]
  std::string hash;   // the trajectory hash of a run that ends then
};

class LiveSession {
 public:
  /// Called for each order, with the script to write. It may not take long.
  using Save = std::function<void(const SaveOrder&, const Script&)>;

  struct Plan {
    bool is_paused = false;
    double speed = 1.0;  // [-] infinity: as fast as it goes
    Save save;
  };

  /// `channels` and `stop` must outlive the session.
  LiveSession(LiveSource source, LiveChannels& channels, Plan plan, const std::atomic<bool>& stop);

  /// Runs until `stop` is set. Throws std::system_error if the run cannot be recorded.
  void run();

 private:
  enum class Goal { none, go, step, update, stage };

  void answer(const Request& request);
  bool control(const Request& request);
  bool intervene(const Request& request);
  void save(const Request& request, const std::string& what);
  void inspect(const Request& request, const asks::Inspect& wanted);
  void go();
  void set_goal(Goal goal, std::int64_t count = 1);
  void move();
  void advance();
  void arrive();
  void watch_stage(std::size_t estimator, seif::Stage stage);
  void hold_stage();
  bool leave_stage(const Request& request);
  const LiveEstimator* watched() const;
  void tell(const Request& request, std::string_view text, bool is_error = false);
  LiveStatus status(bool is_idle) const;
  void publish(bool is_idle = false) { held_->run().publish(status(is_idle)); }

  LiveChannels& channels_;
  Plan plan_;
  const std::atomic<bool>& stop_;
  std::optional<HeldRun> held_;
  Pacer pacer_;
  Goal goal_ = Goal::none;
  std::int64_t goal_count_ = 0;  // [-] steps or updates at which it is reached
  LiveState state_ = LiveState::paused;
  double progress_ = 0.0;  // [-] of a rewinding
  std::string watched_;
  std::optional<BeliefPicture> before_;  // the watched belief, before the stage that comes next
  std::vector<Request> deferred_;        // until the update that is held has ended
};

}  // namespace harness
