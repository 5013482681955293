// The description of the robots of a team.
#pragma once

#include "worlds/describe.hpp"
#include "worlds/fields.hpp"
#include "worlds/load.hpp"

namespace worlds {

/// After the sections of the world, whose sensors and start estimate a robot has unless it says otherwise.
void describe_team(Fields& fields, WorldFile& file, const EstimatorSchemas& estimators);

}  // namespace worlds
