// The resident memory of this process.
#pragma once

namespace harness {

/// Resident memory after the allocator has returned what it does not need. [byte] 0 if the system does not
/// give it.
double resident_bytes();

}  // namespace harness
