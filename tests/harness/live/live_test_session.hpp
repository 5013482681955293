// A live session without a server and without a browser: a test is its only page.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "harness/live/live_pages.hpp"
#include "harness/live/live_session.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/web/page_client.hpp"

namespace harness::test {

class LiveTestSession {
 public:
  explicit LiveTestSession(LiveSource source, bool is_paused = true);
  ~LiveTestSession();
  LiveTestSession(const LiveTestSession&) = delete;
  LiveTestSession& operator=(const LiveTestSession&) = delete;

  /// Sends a request, and returns its number.
  int ask(nlohmann::json request);

  /// The next message of this kind for which `wanted` holds. Throws std::runtime_error after a minute.
  ReceivedMessage wait_for(const std::string& kind,
                           const std::function<bool(const nlohmann::json&)>& wanted = {});
  /// The next frame in this state.
  ReceivedMessage wait_for_state(const std::string& state);
  /// The error that answers this request.
  std::string refusal(nlohmann::json request);
  /// Goes on for so many updates, and returns the frame after the last.
  ReceivedMessage update(int count);

  struct Saved {
    std::string hash;        // of the session
    std::string hash_again;  // of a run of the saved world, from its file
    std::string world;       // the text of the file
  };
  /// Saves what was done, and runs the saved world as `seifbed run` does.
  Saved save();

 private:
  LiveChannels channels_;
  LivePages pages_;
  TemporaryFolder folder_;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> has_saved_ = false;
  SaveOrder order_;
  int seq_ = 0;
  LiveSession session_;
  std::thread thread_;
};

/// A small world with walls in Bullet, with `seif` and `ekf`; a file, as the program reads it.
LiveSource small_source(const TemporaryFolder& folder, std::uint64_t seed, const std::string& more = "");

/// The trajectory hash of a run of a world file.
std::string hash_of_run(const std::filesystem::path& world);

}  // namespace harness::test
