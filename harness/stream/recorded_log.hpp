// A recorded log of any format: a stream with its description.
#pragma once

#include "harness/stream/log_description.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

class RecordedLog : public Stream {
 public:
  virtual const LogDescription& description() const = 0;
};

}  // namespace harness
