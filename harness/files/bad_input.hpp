// The error for wrong input.
#pragma once

#include <stdexcept>

namespace harness {

/// The program was given bad input. what() is a whole message: `file:line:column: reason`.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace harness
