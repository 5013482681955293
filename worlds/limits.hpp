// What a file may ask for before anybody has to say that it is meant so: a slip of the finger, or a file from
// elsewhere, must not take the machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace worlds {

struct Limits {
  std::size_t bytes = std::size_t{4} << 20;  // [byte] of a file
  std::size_t values = 1'000'000;            // [-] of a document, each alias counted with what it stands for
  double landmarks = 2e7;                    // [-] of a world
  std::int64_t fruitless_tries = 5'000'000;  // [-] of a generator to place something, in a row
};

/// Those that hold in this program.
const Limits& limits();

/// Multiplies all of them. To be called once, before anything is read. Throws std::invalid_argument for a
/// factor that is not from 1 to 100: ids are 32 bits wide.
void raise_limits(double factor);

/// For programs that read files by the thousand. To be called before anything is read.
void set_limits(const Limits& limits);

}  // namespace worlds
