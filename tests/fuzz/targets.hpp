// What is fuzzed: everything that reads what people write. Each target takes any bytes at all, and ends the
// program if they make something happen that must not: a crash, another exception than the one for bad input,
// or a promise that is not kept.
#pragma once

#include <map>
#include <string_view>

namespace fuzz {

using Target = void (*)(std::string_view bytes);

/// A world file. What is accepted must load again, to the same, from what it resolves to.
void read_world(std::string_view bytes);

/// A `--set` expression, on a world that has something of everything. What becomes of that must parse again,
/// to the same.
void read_override(std::string_view bytes);

/// An archive of the files of a log in any format: read to its end.
void read_log(std::string_view bytes);

/// An archive of the files of a run's folder: its summary, its scores, and what is whole of it if it was cut
/// off.
void read_run(std::string_view bytes);

/// By the names of their corpora.
const std::map<std::string_view, Target>& targets();

}  // namespace fuzz
