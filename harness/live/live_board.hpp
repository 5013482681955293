// What the pages know of a run: gathered from its snapshots, in the pages' own thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/live/feeds.hpp"
#include "harness/live/live_setting.hpp"
#include "harness/live/message.hpp"
#include "harness/live/snapshot.hpp"

namespace harness {

/// What one page has been told of a board.
struct BoardCursor {
  struct Belief {
    ValueFeed<2>::Cursor means;
    ValueFeed<3>::Cursor ellipses;
    GrowingFeed<LivePoint>::Cursor trail;
    GrowingFeed<LiveChartPoint>::Cursor charts;
    std::uint64_t links = 0;
  };

  std::uint64_t epoch = 0;
  std::uint64_t version = 0;
  std::size_t posts = 0;  // [-] told
  std::uint64_t snapshot = 0;
  std::uint64_t matrix = 0;
  int history = 0;  // [-] messages about the past: trails, charts
  GrowingFeed<LivePoint>::Cursor true_trail, odometry_trail;
  std::vector<Belief> beliefs;
};

class LiveBoard {
 public:
  /// A run has begun anew, or something was put into its world.
  void set(std::shared_ptr<const LiveSetting> setting);

  /// Takes in a snapshot. One of another epoch is ignored.
  void take(const LiveSnapshot& snapshot);

  /// The next message for a page; false if there is nothing new for it. `viewers` is told to the page.
  bool next(BoardCursor& cursor, bool wants_matrix, int viewers, PageMessage& message);

 private:
  struct Belief {
    ValueFeed<2> means;
    ValueFeed<3> ellipses;
    GrowingFeed<LivePoint> trail;
    GrowingFeed<LiveChartPoint> charts;
    std::vector<LiveLink> links;
    std::uint64_t links_version = 0;
    LiveBelief latest;  // without lists
  };

  bool write_setting(BoardCursor& cursor, PageMessage& message);
  bool write_posts(BoardCursor& cursor, PageMessage& message);
  void write_history(BoardCursor& cursor, PageMessage& message);
  void write_frame(BoardCursor& cursor, int viewers, PageMessage& message);
  void add_belief(std::size_t index, BoardCursor::Belief& cursor);
  void write_matrix(BoardCursor& cursor, PageMessage& message) const;

  std::shared_ptr<const LiveSetting> setting_;
  std::uint64_t snapshots_ = 0;  // [-] taken since the setting
  LiveSnapshot latest_;          // without lists, but for the rays
  GrowingFeed<LivePoint> true_trail_, odometry_trail_;
  std::vector<Belief> beliefs_;
  LiveMatrix matrix_;
  std::uint64_t matrix_version_ = 0;

  // Reused.
  MessageArrays arrays_;
  std::vector<std::uint32_t> ids_;
  std::vector<float> floats_;
  std::vector<LivePoint> points_;
  std::vector<LiveChartPoint> charts_;
};

}  // namespace harness
