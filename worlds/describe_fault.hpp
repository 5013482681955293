// The section `faults` of a world file.
#pragma once

#include "worlds/fault.hpp"
#include "worlds/fields.hpp"

namespace worlds {

void describe_fault(Fields& fields, Fault& fault);

}  // namespace worlds
