// The version of this build.
#pragma once

#include <string_view>

namespace harness {

/// The release, and the commit if it is known: "0.1.0 (1a2b3c4)".
std::string_view program_version();

}  // namespace harness
