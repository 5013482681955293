// What of this process is in memory.
#pragma once

namespace harness {

/// Resident, after the allocator has given back what it does not need. [byte] 0 where the system does not
/// tell.
double resident_bytes();

}  // namespace harness
