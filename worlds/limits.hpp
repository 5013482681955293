// Limits on what a file may ask for. A typing mistake, or a file from someone else, must not use up the
// machine. Whoever needs more has to raise the limits explicitly.
#pragma once

#include <cstddef>
#include <cstdint>

namespace worlds {

struct Limits {
  std::size_t bytes = std::size_t{4} << 20;  // [byte] of a file
  std::size_t values = 1'000'000;  // [-] of a document; an alias counts as much as what it stands for
  double landmarks = 2e7;          // [-] of a world
  std::int64_t fruitless_tries = 5'000'000;  // [-] tries of a generator in a row that place nothing
};

/// The limits of this program.
const Limits& limits();

/// Multiplies all limits by a factor. To be called once, before anything is read. Throws std::invalid_argument
/// for a factor outside 1 to 100: ids have 32 bits.
void raise_limits(double factor);

/// Sets all limits, for programs that read thousands of files. To be called before anything is read.
void set_limits(const Limits& limits);

}  // namespace worlds
