// worlds/report2002.yaml as it was when the program was built, so that the program has it in any directory.
#pragma once

#include <string_view>

namespace harness {

/// The text of the world file.
std::string_view report_world();

}  // namespace harness
