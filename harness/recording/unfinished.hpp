// Runs that are still going on, or were cut off: by a kill, a full disk, or a crash of the machine.
#pragma once

#include <filesystem>

namespace harness {

/// A run folder holds a file of this name from the first record until the summary is written. The process that
/// writes the run holds a lock on it.
inline constexpr const char* unfinished_mark = "unfinished";

bool is_unfinished(const std::filesystem::path& run);

/// True if a process is still writing this run.
bool is_going_on(const std::filesystem::path& run);

/// Copies the complete part of such a run to an empty folder: the rows up to the last time that all tables
/// have reached. The copy is a log like any other. Throws BadInput if no part is complete.
void copy_whole_part(const std::filesystem::path& run, const std::filesystem::path& to);

/// The log to read for a run: its own folder; or, if the run goes on or was cut off, `spare`, an empty folder that
/// receives the complete part. The second case is reported on stderr.
std::filesystem::path whole_log(const std::filesystem::path& run, const std::filesystem::path& spare);

}  // namespace harness
