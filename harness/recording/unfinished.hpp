// Runs that were cut off: by a kill, by a disk that was full, or because the machine went down.
#pragma once

#include <filesystem>

namespace harness {

/// A file of this name is in the folder of a run from its first record until its summary is written.
inline constexpr const char* unfinished_mark = "unfinished";

bool is_unfinished(const std::filesystem::path& run);

/// Copies to an empty folder what is whole of such a run: the rows up to the last time that all of its tables
/// have reached, so that it is a log like any other. Throws BadInput if nothing is.
void copy_whole_part(const std::filesystem::path& run, const std::filesystem::path& to);

/// The log to read for a run: its own folder, or, if it was cut off, `spare`, an empty folder, with what is
/// whole of it; then says so on stderr.
std::filesystem::path whole_log(const std::filesystem::path& run, const std::filesystem::path& spare);

}  // namespace harness
