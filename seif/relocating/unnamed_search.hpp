// Finds the place of a robot that is lost in a map whose landmarks have no names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "seif/association/constellation_index.hpp"
#include "seif/association/landmark_grid.hpp"
#include "seif/association/local_belief.hpp"
#include "seif/relocating/constellation_search.hpp"
#include "seif/relocating/local_map.hpp"
#include "seif/relocating/placement.hpp"

namespace seif {

class UnnamedSearch {
 public:
  /// `make_local` makes filters that name landmarks by themselves. `most_chance` [-]: of a wrong match that is as good as
  /// one that is taken.
  UnnamedSearch(LocalBelief& belief, LocalMap::MakeFilter make_local, const Pose2& T_robot_sensor,
                double most_chance);

  /// The landmarks that are looked for, `sighting_sd` [m] as the sensor knows one of them; it sees as far as `reach` [m].
  void use(const LandmarkGrid& grid, double sighting_sd, double reach);

  /// At home: the triangles of landmarks that have joined some time ago are added to the index, a few with each scan.
  void note_joined(LandmarkId landmark, int scan) { young_.push_back({landmark, scan}); }
  void keep_up(int scan);

  bool is_on() const { return local_.is_begun(); }
  void begin();
  void end();

  void motion_update(const Odometry& odometry) { local_.motion_update(odometry); }
  /// Goes on with a scan. `T_world_robot`: what the filter believes. If the robot is found, its surroundings with the
  /// names of the map; no_landmark for those that are new.
  std::optional<Relocation> measurement_update(const Scan& scan, const Pose2& T_world_robot);

  std::int64_t work() const { return work_ + (search_ ? search_->work() : 0); }
  std::size_t memory_bytes() const;

 private:
  struct Young {
    LandmarkId landmark;
    int joined;  // [-] scan
  };

  bool place(const ConstellationSearch::Found& found, Placement& placement, double t);
  double log_chance(const ConstellationSearch::Found& found, const Placement& placement) const;
  Relocation named(const Placement& placement, const Pose2& T_world_robot) const;

  LocalBelief& belief_;
  LocalMap local_;
  double most_log_chance_;
  const LandmarkGrid* grid_ = nullptr;
  std::optional<ConstellationIndex> index_;
  std::optional<ConstellationSearch> search_;
  double near_ = 0.0, reach_ = 0.0;  // [m]
  std::vector<Young> young_;
  std::size_t next_young_ = 0;
  Surroundings surroundings_;
  std::int64_t work_ = 0;
};

}  // namespace seif
