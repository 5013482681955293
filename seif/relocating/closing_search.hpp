// Finds that landmarks which have joined the map lately are in it already: the robot has come back without noticing it.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "seif/association/local_belief.hpp"
#include "seif/relocating/constellation_search.hpp"
#include "seif/relocating/settled_constellations.hpp"
#include "seif/relocating/surroundings.hpp"

namespace seif {

/// Landmarks around the robot that have twins in the map.
struct Closing {
  struct Twins {
    LandmarkId young, old;
  };
  std::vector<Twins> twins;
  std::vector<LandmarkId> around;  // all young ones around the robot
  /// Set if the filter's belief contradicts that they are one, as after a slip that nobody noticed: the robot is put
  /// back among the old ones.
  std::optional<Relocation> relocation;
};

class ClosingSearch {
 public:
  /// `most_log_chance` [nat]: of a wrong match that is as good as one that is taken.
  ClosingSearch(LocalBelief& belief, const SettledConstellations& map, double most_log_chance)
      : belief_(belief), map_(map), most_log_chance_(most_log_chance) {}

  /// To be called when landmarks have settled. What was seen lately joined with or after `oldest_seen`, so it cannot be
  /// what joined before. Bounded work.
  std::optional<Closing> look(const Pose2& T_world_robot, LandmarkId oldest_seen, double t);

  std::int64_t work() const { return work_ + (search_ ? search_->work() : 0); }

 private:
  bool find_around(const Pose2& T_world_robot, LandmarkId oldest_seen);
  void look_from_settled(const Pose2& T_world_robot);
  std::optional<Closing> verify(const Pose2& T_world_robot, const ConstellationSearch::Found& found,
                                double t);
  bool contradicts(const std::vector<Closing::Twins>& twins) const;

  LocalBelief& belief_;
  const SettledConstellations& map_;
  double most_log_chance_;
  std::optional<ConstellationSearch> search_;
  ConstellationSearch::Points around_;
  std::vector<LandmarkGrid::Near> near_;
  std::int64_t work_ = 0;
};

}  // namespace seif
