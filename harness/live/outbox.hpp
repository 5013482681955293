// What the run tells the pages besides its snapshots: answers, pictures of stages, a new setting. Seldom used, so
// it has a lock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include "harness/live/live_setting.hpp"
#include "harness/web/page_server.hpp"

namespace harness {

struct Letter {
  std::optional<PageId> to;  // empty: to all pages
  PageMessage message;
};

class Outbox {
 public:
  /// Drops the oldest letter if too many are waiting.
  void send(Letter letter) {
    const std::lock_guard lock(mutex_);
    if (letters_.size() >= most) letters_.pop_front();
    letters_.push_back(std::move(letter));
  }

  void set(std::shared_ptr<const LiveSetting> setting) {
    const std::lock_guard lock(mutex_);
    setting_ = std::move(setting);
  }

  std::deque<Letter> take_letters() {
    const std::lock_guard lock(mutex_);
    return std::exchange(letters_, {});
  }

  /// A setting that has not been taken yet; null if there is none.
  std::shared_ptr<const LiveSetting> take_setting() {
    const std::lock_guard lock(mutex_);
    return std::exchange(setting_, nullptr);
  }

 private:
  static constexpr std::size_t most = 256;  // [-]

  std::mutex mutex_;
  std::deque<Letter> letters_;
  std::shared_ptr<const LiveSetting> setting_;
};

/// `{"kind":"said",..}`: a text for the user of a page.
PageMessage said(bool is_error, std::string_view text, std::int64_t seq);

}  // namespace harness
