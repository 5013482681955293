// Runs that were cut off: by a kill, a full disk, or a crash of the machine.
#pragma once

#include <filesystem>

namespace harness {

/// A file of this name is in the folder of a run from its first record until its summary is written.
inline constexpr const char* unfinished_mark = "unfinished";

bool is_unfinished(const std::filesystem::path& run);

/// Copies the complete part of such a run to an empty folder: the rows up to the last time that all tables have
/// reached, so that it is a log like any other. Throws BadInput if there is none.
void copy_whole_part(const std::filesystem::path& run, const std::filesystem::path& to);

/// The log to read for a run: its own folder, or, if it was cut off, `spare` (an empty folder) with its complete
/// part; then says so on stderr.
std::filesystem::path whole_log(const std::filesystem::path& run, const std::filesystem::path& spare);

}  // namespace harness
