// Reads from an estimator what the pages of a live run show, a bounded part of it at a time.
#pragma once

#include <chrono>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "harness/film/matrix_picture.hpp"
#include "harness/film/point_index.hpp"
#include "harness/live/running_figures.hpp"
#include "harness/live/snapshot.hpp"
#include "harness/live/thrift.hpp"
#include "harness/live/trail_points.hpp"
#include "harness/live/view_wish.hpp"
#include "harness/run/live_estimator.hpp"
#include "harness/stream/run_listener.hpp"

namespace harness {

class BeliefReader {
 public:
  using Clock = std::chrono::steady_clock;

  /// `estimator` must outlive the reader.
  explicit BeliefReader(const LiveEstimator& estimator);

  void scan(const ScanEvent& event);
  void update(const UpdateRecord& record);
  void consistency(const ConsistencyRecord& record) { figures_.consistency(record); }

  /// How much may be read.
  enum class Depth { pose, little, much };

  /// Reads what has changed. Depth::pose: only the pose and the links to the robot, as in the middle of an update.
  /// Returns what was spent on readings that have a thrift of their own.
  Clock::duration read(const LiveView& view, Depth depth, LiveBelief& out);

  /// Reads the picture of the whole matrix if that is affordable now. False: it was not read.
  bool read_matrix(LiveMatrix& out);

  const LiveEstimator& estimator() const { return estimator_; }

 private:
  struct Known {
    seif::LandmarkId landmark;
    LivePoint told;
    bool was_told = false;
  };

  void read_all(const LiveView& view, Depth depth, LiveBelief& out);
  void count(Thrift& thrift, Clock::time_point begin);
  void note(seif::LandmarkId landmark);
  void read_active(LiveBelief& out);
  void read_means(std::size_t others, LiveBelief& out);
  void read_links(const LiveView& view, LiveBelief& out);
  void read_ellipses(const LiveView& view, LiveBelief& out);
  void find_shown(const LiveView& view, std::size_t most);

  const LiveEstimator& estimator_;
  RunningFigures figures_;
  TrailPoints trail_;
  PointIndex means_{4.0};                                      // landmarks that have been read
  std::vector<Known> known_;                                   // in the order in which they were first seen
  std::unordered_map<seif::LandmarkId, std::size_t> numbers_;  // of `known_`
  std::vector<seif::LandmarkId> noted_;                        // seen since the last reading
  std::size_t turn_ = 0;  // number of the landmark that is read next in turn
  Area area_;             // [m] that links and ellipses were read for
  bool is_stale_ = true;  // an update has come since links were read
  bool has_stale_ellipses_ = true;
  Thrift links_thrift_, ellipses_thrift_, matrix_thrift_;
  bool is_idle_ = false;        // during a reading: the run waits
  Clock::duration apart_ = {};  // of a reading
  MatrixPicture picture_;

  // Reused.
  std::vector<seif::LandmarkId> wanted_, shown_;
  std::vector<seif::LandmarkEstimate> estimates_;
  std::vector<seif::Coupling> couplings_;
};

}  // namespace harness
