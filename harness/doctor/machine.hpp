// Checks what this machine offers to the program.
#pragma once

#include <vector>

#include "harness/doctor/diagnosis.hpp"

namespace harness {

/// Cores, memory, disk space, the graphics library, ffmpeg and its codecs, gnuplot, Chart.js and three.js. A finding is bad if a
/// command of this program would fail.
std::vector<Finding> look_at_machine();

}  // namespace harness
