// Each file includes the standard headers that it uses, itself or in its own header. Unity builds and precompiled
// headers would hide one that is missing.
#pragma once

#include <vector>

#include "rules.hpp"
#include "source.hpp"

namespace rooms {

/// The names of namespace std whose header neither a file nor the header of the same name includes, as
/// `path:line: what is wrong`, each header once for each file.
Findings check_standard_headers(const std::vector<Source>& sources);

}  // namespace rooms
