// What the machine has of what this program uses.
#pragma once

#include <vector>

#include "harness/doctor/diagnosis.hpp"

namespace harness {

/// Cores, memory, room on the disk, the graphics library, ffmpeg and its codecs, gnuplot. Bad is what a
/// command of this program would fail for.
std::vector<Finding> look_at_machine();

}  // namespace harness
