// The fuzz targets: all code that reads files written by people. Each target takes any bytes, and ends the
// program on an error: a crash, an exception other than the one for bad input, or a broken promise.
#pragma once

#include <map>
#include <string_view>

namespace fuzz {

using Target = void (*)(std::string_view bytes);

/// Reads a world file. An accepted file must resolve to a document that loads to the same world.
void read_world(std::string_view bytes);

/// Applies a `--set` expression to a world that has every kind of section. The result must parse again to the
/// same document.
void read_override(std::string_view bytes);

/// Reads an archive of the files of a log, in any format, to its end.
void read_log(std::string_view bytes);

/// Reads an archive of the files of a run's folder: its summary, its scores, and the complete part of a run
/// that was cut off.
void read_run(std::string_view bytes);

/// Reads a message from a page of a live run.
void read_request(std::string_view bytes);

/// The targets by the names of their corpora.
const std::map<std::string_view, Target>& targets();

}  // namespace fuzz
