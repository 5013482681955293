// A log that was recorded, whatever its format: a stream with what stands beside its rows.
#pragma once

#include "harness/stream/log_description.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

class RecordedLog : public Stream {
 public:
  virtual const LogDescription& description() const = 0;
};

}  // namespace harness
