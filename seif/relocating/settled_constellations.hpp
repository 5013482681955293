// The constellations of all landmarks that have been in the map for some time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seif/association/constellation_index.hpp"
#include "seif/association/landmark_grid.hpp"
#include "seif/types.hpp"

namespace seif {

class SettledConstellations {
 public:
  explicit SettledConstellations(const LandmarkGrid& grid) : grid_(grid) {}

  /// What the robot has seen: so far away [m], and with this standard deviation [m].
  void widen(double range, double sighting_sd);
  void note_joined(LandmarkId landmark, int scan) { young_.push_back({landmark, scan}); }

  /// Adds landmarks that joined some time ago, a few with each scan.
  void keep_up(int scan);
  /// Those that the last keep_up() has added.
  std::span<const LandmarkId> just_settled() const { return just_settled_; }
  /// Adds all.
  void settle_all();

  const LandmarkGrid& grid() const { return grid_; }
  const ConstellationIndex& index() const { return *index_; }
  bool is_empty() const { return !index_ || index_->size() == 0; }
  /// How near to a landmark something must be to be taken for it, before covariances are known. [m]
  double near() const { return near_; }
  double reach() const { return reach_; }  // [m] of the robot so far

  std::int64_t work() const { return work_; }  // [-] landmarks looked at
  std::size_t memory_bytes() const;

 private:
  struct Young {
    LandmarkId landmark;
    int joined;  // [-] scan
  };

  void add_next();

  const LandmarkGrid& grid_;
  std::optional<ConstellationIndex> index_;  // made once it is known how exactly the robot sees
  double near_ = 0.0, reach_ = 0.0;
  double sighting_sd_ = 0.0;    // [m] mean
  std::int64_t sightings_ = 0;  // [-]
  std::vector<Young> young_;
  std::size_t next_young_ = 0;
  std::vector<LandmarkId> just_settled_;
  std::int64_t work_ = 0;
};

}  // namespace seif
