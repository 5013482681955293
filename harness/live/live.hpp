// Shows runs live in a browser.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "harness/live/live_run.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/web/page_server.hpp"

namespace harness {

struct LiveOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;     // 0: any free one
  bool opens_browser = true;  // where there is a display
  bool is_paused = false;     // at the beginning
  double speed = 1.0;         // [-] infinity: as fast as it goes
};

/// A run that its pages control, until Ctrl-C. Saved runs go into runs/. Throws what making the run throws,
/// std::system_error if the address cannot be used, and std::runtime_error if a library is not installed.
void show_live(LiveSource source, const LiveOptions& options);

/// Lets pages look at a run that goes on anyway, and change nothing.
class LiveOnlookers {
 public:
  LiveOnlookers(const worlds::World& world, const PreparedRun& run, const seif::Registry& registry,
                const LiveOptions& options);
  ~LiveOnlookers();
  LiveOnlookers(const LiveOnlookers&) = delete;
  LiveOnlookers& operator=(const LiveOnlookers&) = delete;

  /// To be told all events of the run.
  RunListener& listener();

 private:
  class Core;

  std::unique_ptr<Core> core_;
};

}  // namespace harness
