// The film of a finished run, from its folder. Nothing is simulated again: truth and wheel angles are in the
// log, the filters get the log once more, and the times of their updates are the recorded ones.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/film/film.hpp"
#include "harness/run/prepared_run.hpp"
#include "seif/registry.hpp"
#include "worlds/load.hpp"

namespace harness {

/// A folder that is ready to be filmed.
struct FilmableFolder {
  PreparedRun replay;  // of the estimators that are filmed
  FilmPlan plan;       // but for the clock
};

/// Appends errors of the settings to `problems`; then there is nothing to film. `overrides` are
/// of a world file's film section. Throws BadInput if the log cannot be read, or for an
/// override of something else.
std::optional<FilmableFolder> prepare_film(const std::filesystem::path& folder,
                                           const std::vector<std::string>& overrides,
                                           const seif::Registry& registry,
                                           std::vector<worlds::Problem>& problems);

struct FilmResult {
  std::int64_t frames = 0;  // [-]
  bool interrupted = false;
};

/// Throws BadInput if the log cannot be read on, and std::runtime_error if the film cannot be made.
FilmResult film_folder(FilmableFolder& folder, const std::filesystem::path& log,
                       std::unique_ptr<FrameSink> sink, bool quiet);

}  // namespace harness
