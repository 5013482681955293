// What the open pages want to see, told by their thread to that of the run.
#pragma once

#include <mutex>

#include "harness/film/point_index.hpp"

namespace harness {

struct LiveView {
  int pages = 0;  // [-] open ones
  Area area;      // [m] the ground that any of them shows
  bool matrix = false;
  bool links = false;
};

class ViewWish {
 public:
  void set(const LiveView& view) {
    const std::lock_guard lock(mutex_);
    view_ = view;
  }

  /// Updates `view`, unless the other thread is just writing: then it stays as it was.
  void get(LiveView& view) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) view = view_;
  }

 private:
  std::mutex mutex_;
  LiveView view_;
};

}  // namespace harness
