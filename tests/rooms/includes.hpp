// Each file includes the standard headers that it uses, itself or in its own header. Unity builds and
// precompiled headers would hide a missing include.
#pragma once

#include <vector>

#include "rules.hpp"
#include "source.hpp"

namespace rooms {

/// Finds names of namespace std whose header is included neither by the file nor by the header of the same
/// name, as `path:line: what is wrong`. Each header is reported once per file.
Findings check_standard_headers(const std::vector<Source>& sources);

}  // namespace rooms
