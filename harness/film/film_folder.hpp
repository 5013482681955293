// Films a finished run from its folder, without simulating it again. Truth and wheel angles are in the log.
// The filters process the log once more; the update times are those of the recorded run.
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

/// A run folder that is ready to be filmed.
struct FilmableFolder {
  PreparedRun replay;  // with the filmed estimators only
  FilmPlan plan;       // complete but for clock and path
};

/// Prepares the film of a run folder. Problems with the settings are appended to `problems`; the result is
/// then empty. `overrides` change the film section of a world file. Throws BadInput if the log cannot be
/// read, or if an override is for another section.
std::optional<FilmableFolder> prepare_film(const std::filesystem::path& folder,
                                           const std::vector<std::string>& overrides,
                                           const seif::Registry& registry,
                                           std::vector<worlds::Problem>& problems);

/// The area of the robot's true path from `from` to `to` [s], both of the log's clock. Empty if the log has no
/// truth. [m]
std::optional<Area> path_area(const std::filesystem::path& log, double from, double to);

struct FilmResult {
  std::int64_t frames = 0;  // [-]
  bool interrupted = false;
};

/// Draws the film. Throws BadInput if the log cannot be read to its end, and std::runtime_error if the film
/// cannot be made.
FilmResult film_folder(FilmableFolder& folder, const std::filesystem::path& log,
                       std::unique_ptr<FrameSink> sink, bool quiet);

}  // namespace harness
