// Finds the place of a robot that is lost in a map whose landmarks have no names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "seif/association/local_belief.hpp"
#include "seif/relocating/constellation_search.hpp"
#include "seif/relocating/local_map.hpp"
#include "seif/relocating/placement.hpp"
#include "seif/relocating/settled_constellations.hpp"

namespace seif {

class UnnamedSearch {
 public:
  /// `make_local` makes filters that name landmarks by themselves. `most_log_chance` [nat]: of a wrong match that is as
  /// good as one that is taken.
  UnnamedSearch(LocalBelief& belief, const SettledConstellations& map, LocalMap::MakeFilter make_local,
                const Pose2& T_robot_sensor, double most_log_chance);

  bool is_on() const { return local_.is_begun(); }
  void begin();
  void end();

  void motion_update(const Odometry& odometry) { local_.motion_update(odometry); }
  /// Goes on with a scan. `T_world_robot`: what the filter believes. If the robot is found, its surroundings with the
  /// names of the map; no_landmark for those that are new.
  std::optional<Relocation> measurement_update(const Scan& scan, const Pose2& T_world_robot);

  std::int64_t work() const { return work_ + (search_ ? search_->work() : 0); }
  std::size_t memory_bytes() const { return local_.is_begun() ? local_.filter().memory_bytes() : 0; }

 private:
  bool breaks_off(const Scan& scan);

  LocalBelief& belief_;
  const SettledConstellations& map_;
  LocalMap local_;
  double most_log_chance_;
  std::optional<ConstellationSearch> search_;
  bool has_fitted_ = false;  // the local map, to a scan
  int broken_ = 0;           // [-] scans in a row that do not fit to it
  std::int64_t work_ = 0;
};

}  // namespace seif
