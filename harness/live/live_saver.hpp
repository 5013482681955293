// Saves what was done in a live session: runs it again in processes of its own, and compares the bits.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "harness/live/live_session.hpp"
#include "harness/live/outbox.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {

/// One order after the other, in a thread of its own.
class LiveSaver {
 public:
  /// `program` is the path of seifbed; `folder` the one in which run folders are made. `outbox` must outlive it.
  LiveSaver(std::filesystem::path program, std::filesystem::path folder, Outbox& outbox);
  /// Ends after the order that is being carried out.
  ~LiveSaver();
  LiveSaver(const LiveSaver&) = delete;
  LiveSaver& operator=(const LiveSaver&) = delete;

  /// Writes the script to a temporary file, and returns. Throws BadInput if the script cannot be written.
  void save(const SaveOrder& order, const Script& script);

 private:
  struct Job {
    SaveOrder order;
    std::unique_ptr<TemporaryFolder> script;
  };

  void work();
  void carry_out(const Job& job);
  void call(const std::vector<std::string>& arguments) const;

  std::filesystem::path program_;
  std::filesystem::path folder_;
  Outbox& outbox_;
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Job> jobs_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace harness
