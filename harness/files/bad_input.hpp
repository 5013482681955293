// The error for invalid input from the user.
#pragma once

#include <stdexcept>

namespace harness {

/// The input is invalid. what() is a complete message: `file:line:column: reason`.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace harness
