// Verifies what a search by constellations has found: by the filter's covariance, and by how probable chance is.
#pragma once

#include <cstddef>

#include "seif/association/local_belief.hpp"
#include "seif/relocating/constellation_search.hpp"
#include "seif/relocating/placement.hpp"
#include "seif/relocating/settled_constellations.hpp"
#include "seif/relocating/surroundings.hpp"

namespace seif {

/// Fits the surroundings to the landmarks at hand that they are taken for, by the filter's covariance. False if too few
/// agree. `T_local_robot`: in the frame of the search.
[[nodiscard]] bool place(const LocalBelief& belief, const Surroundings& surroundings,
                         const ConstellationSearch::Found& found, const Pose2& T_local_robot,
                         Placement& placement);

/// [nat] How many matches as good as this are to be expected by chance: an upper bound of the probability that there is
/// one. Of `points`, those of the placement lie at landmarks of the map, which are scattered with a density. The
/// coordinates of m landmarks that some pose fits with v' S^-1 v <= q fill, of their space of 2m dimensions, a tube
/// around all poses; it is as thick as a ball of 2m - 3 dimensions.
double log_chance(std::size_t points, const ConstellationSearch::Found& found, const Placement& placement);

/// The surroundings with the names of the map, no_landmark for those that are new. What lies beside a landmark of the
/// map, and is not clearly that one, is left out.
Relocation named_relocation(const LocalBelief& belief, const SettledConstellations& map,
                            const Surroundings& surroundings, const Placement& placement,
                            const Pose2& T_world_robot);

}  // namespace seif
